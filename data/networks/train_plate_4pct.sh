#!/bin/sh
# Trains the shipped network on the records of data/cfd and writes it beside this file; the learning curves and
# the errors on each record go to standard output. Further options are handed on: --folds 6 adds the
# cross-validation that docs/PLATE_NETWORK.md is made of.
#
#   data/networks/train_plate_4pct.sh [AEROM [OPTION...]]
set -eu
root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
aerom=${1:-$root/build/release/bin/aerom}
[ $# -eq 0 ] || shift
inputs=alpha_lag_1,alpha_lag_2,alpha_lag_3,alpha_lag_4,pitch_rate_lag_1,pitch_rate_lag_2
inputs=alpha,pitch_rate,$inputs,stall_bubble,stall_moment,stall_lost
exec "$aerom" train "$root/data/cfd" --name plate-4pct --polar plate-4pct-channel \
    --base dynamic_stall --lags 0.5,1.5,4,12 --inputs "$inputs" --hidden 16 --members 6 --samples 100 \
    --anchors 3000 \
    --description "What flow computations of the 4 % plate have beyond dynamic stall, from angle, rate and their lags" \
    --output "$root/data/networks/plate-4pct.json" "$@"
