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
inputs=alpha,pitch_rate
inputs=$inputs,alpha_lag_1,alpha_lag_2,alpha_lag_3,alpha_lag_4
inputs=$inputs,pitch_rate_lag_1,pitch_rate_lag_2,pitch_rate_lag_3
for n in 1 2; do
    inputs=$inputs,alpha_oscillator_$n,alpha_oscillator_rate_$n
    inputs=$inputs,pitch_rate_oscillator_$n,pitch_rate_oscillator_rate_$n
done
inputs=$inputs,stall_bubble,stall_moment,stall_lost
exec "$aerom" train "$root/data/cfd" --name plate-4pct --polar plate-4pct-channel \
    --base dynamic_stall --lags 0.2,0.6,2,8 --oscillators 0.55:0.15,0.85:0.2 --inputs "$inputs" \
    --hidden 20 --members 6 --samples 100 --anchors 3000 --balance 0.05 --tolerance 0.05 \
    --description "What flow computations of the 4 % plate have beyond dynamic stall, from angle and rate, their lags and oscillators" \
    --output "$root/data/networks/plate-4pct.json" "$@"
