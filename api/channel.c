#include "api/channel.h"

#include "core/num.h"

#include <assert.h>
#include <stdio.h>
#include <string.h>

/* What a channel has one column for each of. */
enum channel_shape { SHAPE_SCALAR, SHAPE_MODES, SHAPE_STATIONS };

const char *const channel_names[CHANNEL_COUNT + 1] = {
    [CHANNEL_TIP_PLUNGE] = "tip_plunge_m",
    [CHANNEL_TIP_TWIST] = "tip_twist_deg",
    [CHANNEL_TIP_CHORDWISE] = "tip_chordwise_m",
    [CHANNEL_LIFT] = "lift_n",
    [CHANNEL_DRAG] = "drag_n",
    [CHANNEL_MOMENT] = "moment_n_m",
    [CHANNEL_CL] = "cl",
    [CHANNEL_CD] = "cd",
    [CHANNEL_CM] = "cm",
    [CHANNEL_EFFICIENCY] = "efficiency",
    [CHANNEL_ROOT_BENDING] = "root_bending_n_m",
    [CHANNEL_GUST] = "gust_m_s",
    [CHANNEL_ROOT_PITCH] = "root_pitch_deg",
    [CHANNEL_ROOT_PLUNGE] = "root_plunge_m",
    [CHANNEL_MODAL_AMPLITUDE] = "modal_amplitude",
    [CHANNEL_MODAL_VELOCITY] = "modal_velocity",
    [CHANNEL_STATION_PLUNGE] = "station_plunge_m",
    [CHANNEL_STATION_TWIST] = "station_twist_deg",
    [CHANNEL_STATION_ALPHA] = "station_alpha_deg",
    [CHANNEL_STATION_INDUCED] = "station_induced_deg",
    [CHANNEL_STATION_CL] = "station_cl",
    [CHANNEL_STATION_CD] = "station_cd",
    [CHANNEL_STATION_CM] = "station_cm",
};

static const struct {
    bool angle; /* radians inside, degrees outside */
    enum channel_shape shape;
} channel_table[CHANNEL_COUNT] = {
    [CHANNEL_TIP_PLUNGE] = {false, SHAPE_SCALAR},
    [CHANNEL_TIP_TWIST] = {true, SHAPE_SCALAR},
    [CHANNEL_TIP_CHORDWISE] = {false, SHAPE_SCALAR},
    [CHANNEL_LIFT] = {false, SHAPE_SCALAR},
    [CHANNEL_DRAG] = {false, SHAPE_SCALAR},
    [CHANNEL_MOMENT] = {false, SHAPE_SCALAR},
    [CHANNEL_CL] = {false, SHAPE_SCALAR},
    [CHANNEL_CD] = {false, SHAPE_SCALAR},
    [CHANNEL_CM] = {false, SHAPE_SCALAR},
    [CHANNEL_EFFICIENCY] = {false, SHAPE_SCALAR},
    [CHANNEL_ROOT_BENDING] = {false, SHAPE_SCALAR},
    [CHANNEL_GUST] = {false, SHAPE_SCALAR},
    [CHANNEL_ROOT_PITCH] = {true, SHAPE_SCALAR},
    [CHANNEL_ROOT_PLUNGE] = {false, SHAPE_SCALAR},
    [CHANNEL_MODAL_AMPLITUDE] = {false, SHAPE_MODES},
    [CHANNEL_MODAL_VELOCITY] = {false, SHAPE_MODES},
    [CHANNEL_STATION_PLUNGE] = {false, SHAPE_STATIONS},
    [CHANNEL_STATION_TWIST] = {true, SHAPE_STATIONS},
    [CHANNEL_STATION_ALPHA] = {true, SHAPE_STATIONS},
    [CHANNEL_STATION_INDUCED] = {true, SHAPE_STATIONS},
    [CHANNEL_STATION_CL] = {false, SHAPE_STATIONS},
    [CHANNEL_STATION_CD] = {false, SHAPE_STATIONS},
    [CHANNEL_STATION_CM] = {false, SHAPE_STATIONS},
};

const char *channel_name(enum channel channel)
{
    assert((unsigned)channel < CHANNEL_COUNT);
    return channel_names[channel];
}

bool channel_parse(const char *name, enum channel *out)
{
    for (int i = 0; i < CHANNEL_COUNT; i++) {
        if (strcmp(channel_names[i], name) == 0) {
            *out = (enum channel)i;
            return true;
        }
    }
    return false;
}

double channel_scale(enum channel channel)
{
    assert((unsigned)channel < CHANNEL_COUNT);
    return channel_table[channel].angle ? 180.0 / NUM_PI : 1.0;
}

/* What sim_column holds of a section in prescribed motion. */
static bool loop_column(const struct case_def *def, int column, char name[64], double *scale)
{
    static const char *const names[] = {"alpha_deg", "w", "cl", "cm", "cd"};
    const int n = polar_def_has_drag(def->aero.polar) ? 5 : 4;
    if (column >= n) {
        return false;
    }
    (void)snprintf(name, 64, "%s", names[column]);
    *scale = column == 0 ? 180.0 / NUM_PI : 1.0;
    return true;
}

bool channel_column(const struct case_def *def, int column, char name[64], double *scale)
{
    assert(column >= 0);
    if (def->kind == CASE_LOOP) {
        return loop_column(def, column, name, scale);
    }
    for (int i = 0; i < def->output.n_channel; i++) {
        const enum channel c = def->output.channel[i];
        const int n = case_def_channel_columns(def, c);
        if (column >= n) {
            column -= n;
            continue;
        }
        if (channel_table[c].shape == SHAPE_SCALAR) {
            (void)snprintf(name, 64, "%s", channel_names[c]);
        } else {
            (void)snprintf(name, 64, "%s[%d]", channel_names[c], column + 1);
        }
        *scale = channel_scale(c);
        return true;
    }
    return false;
}
