/* Gusts and prescribed motion of the clamp, through the facade: a rigid wing against Kuessner and
 * Theodorsen, a flexible one in a vacuum against the closed forms of base excitation. */
#include "core/num.h"
#include "core/sim.h"
#include "tests/support/fixture.h"
#include "tests/support/wake_functions.h"
#include "tests/verify/built.h"
#include "tests/verify/check.h"

#include <complex.h>
#include <stdlib.h>

static const double speed = 20.0, chord = 0.5, length = 4.0;
enum { CL, CM, PLUNGE, TWIST, BENDING, CHANNELS };

/* Axes at mid-chord; the stiffness is `rigid` times that of a soft wing. */
static void wing(double rigid, const struct polar_def *polar, struct case_def *def)
{
    case_def_defaults(def);
    def->beam.length = length;
    section_def_defaults(SECTION_PROPERTIES, &def->beam.section);
    struct properties *p = &def->beam.section.properties;
    p->chord = chord;
    p->ei_flap = 2e3 * rigid;
    p->gj = 1e3 * rigid;
    p->mass = 0.75;
    p->torsion_inertia = 0.03;
    properties_complete(p);
    def->flow.speed = speed;
    def->aero.polar = polar;
    def->aero.lifting_line = false;
    def->aero.dynamic = DYNAMIC_ATTACHED;
    def->output.n_channel = CHANNELS;
    def->output.channel[CL] = CHANNEL_CL;
    def->output.channel[CM] = CHANNEL_CM;
    def->output.channel[PLUNGE] = CHANNEL_TIP_PLUNGE;
    def->output.channel[TWIST] = CHANNEL_TIP_TWIST;
    def->output.channel[BENDING] = CHANNEL_ROOT_BENDING;
}

static void sharp_edged_gust(struct check_list *list)
{
    static const double semichords[6] = {0.5, 1.0, 2.0, 5.0, 10.0, 25.0};
    struct polar_def polar = fixture_linear_polar(2.0 * NUM_PI, NUM_PI / 2.0, 0.0, 1.0);
    struct case_def def;
    wing(1e10, &polar, &def);
    def.solver.modes = 2;
    def.solver.modal_damping = 0.5; /* no ringing of the stiff wing */
    const double unit = chord / (2.0 * speed), gust = 0.4;
    def.solver.time_step = unit / 500.0;
    def.solver.duration = 26.0 * unit;
    def.flow.gust = (struct gust_def){.given = true, .type = GUST_STEP, .amplitude = gust};
    struct sim *sim = built_run(&def);
    for (int i = 0; i < 6; i++) {
        /* The step rises over one time step: it comes half of it late. */
        const double s = semichords[i] - 0.5 / 500.0;
        const int sample = (int)(semichords[i] * 500.0 + 0.5);
        const double cl = sim_column(sim, CL)[sample] / (2.0 * NUM_PI * gust / speed);
        check_add(list, CHECK_ABSOLUTE, "", cl, wake_kuessner(s), 0.0021,
                  "closed form: Garrick's integral",
                  "attached, sharp-edged gust, s = %g: c_l / "
                  "(2 pi w/V)",
                  semichords[i]);
    }
    check_add(list, CHECK_ABSOLUTE, "", sim_column(sim, CM)[5000] / sim_column(sim, CL)[5000], 0.25,
              1e-3, "thin-aerofoil theory",
              "attached, sharp-edged gust, s = 10: lift at the "
              "quarter point, c_m / c_l");
    sim_destroy(sim);
    def.aero.dynamic = DYNAMIC_NONE;
    sim = built_run(&def);
    check_add(list, CHECK_RELATIVE, "", sim_column(sim, CL)[100], 2.0 * NUM_PI * gust / speed, 1e-3,
              "property", "quasi-steady, sharp-edged gust: c_l at once");
    sim_destroy(sim);
    polar_def_done(&polar);
}

/* Complex amplitude of a channel at a frequency over the last `periods` of the drive; phase of a
 * sine of the drive. */
static double complex amplitude(const struct sim *sim, int channel, double omega, int periods)
{
    const struct sim_result *r = sim_result(sim);
    const double *y = sim_column(sim, channel);
    const double span = periods * 2.0 * NUM_PI / omega;
    const int n = (int)floor(span / r->sample_step + 0.5);
    double complex sum = 0.0;
    for (int i = r->n_sample - n; i < r->n_sample; i++) {
        sum += y[i] * cexp(NUM_COMPLEX(0.0, -omega * i * r->sample_step));
    }
    return NUM_COMPLEX(0.0, 2.0) * sum / n;
}

/* Harmonic motion of the clamp at a reduced frequency, some periods after it has faded in. */
static struct sim *swing(struct case_def *def, struct drive_def *drive, double size, double omega)
{
    const double period = 2.0 * NUM_PI / omega;
    drive_defaults(DRIVE_SINE, drive);
    drive->amplitude = size;
    drive->frequency = 1.0 / period;
    drive_complete(drive);
    def->solver.time_step = period / 400.0;
    def->solver.duration = 24.0 * period;
    return built_run(def);
}

static void forced_section(struct check_list *list)
{
    static const char *const table = "[C], validation data 4.4";
    static const struct {
        double k;
        double cl[2], cm[2];
    } pitch[3] = {{0.1, {5.2813, -0.5071}, {1.3223, -0.2839}},
                  {0.3927, {4.1468, 0.9643}, {1.0670, -0.3758}},
                  {1.0, {3.7044, 4.2062}, {1.1224, -0.5192}}};
    struct polar_def polar = fixture_linear_polar(2.0 * NUM_PI, NUM_PI / 2.0, 0.0, 1.0);
    struct case_def def;
    const double alpha = 0.01;
    for (int i = 0; i < 3; i++) {
        wing(1e10, &polar, &def);
        def.solver.modes = 2;
        def.solver.modal_damping = 0.5; /* no ringing of the stiff wing */
        const double omega = pitch[i].k * 2.0 * speed / chord;
        struct sim *sim = swing(&def, &def.beam.root_pitch, alpha, omega);
        const double complex cl = amplitude(sim, CL, omega, 4) / alpha;
        const double complex cm = amplitude(sim, CM, omega, 4) / alpha;
        const double complex l = NUM_COMPLEX(pitch[i].cl[0], pitch[i].cl[1]);
        const double complex m = NUM_COMPLEX(pitch[i].cm[0], pitch[i].cm[1]);
        check_add(list, CHECK_AT_MOST, "", cabs(cl / l - 1.0), 0.0, 0.005, table,
                  "clamp pitches, k = %g: c_l, ours / Theodorsen - 1", pitch[i].k);
        check_add(list, CHECK_AT_MOST, "", cabs(cm / m - 1.0), 0.0, 0.005, table,
                  "clamp pitches, k = %g: c_m, ours / Theodorsen - 1", pitch[i].k);
        sim_destroy(sim);
    }
    /* Table: per h/b, h down. */
    wing(1e10, &polar, &def);
    def.solver.modes = 2;
    def.solver.modal_damping = 0.5; /* no ringing of the stiff wing */
    const double omega = 0.3927 * 2.0 * speed / chord, h = 0.002;
    struct sim *sim = swing(&def, &def.beam.root_plunge, h, omega);
    const double complex scale = -0.5 * chord / h;
    check_add(list, CHECK_AT_MOST, "",
              cabs(amplitude(sim, CL, omega, 4) * scale / NUM_COMPLEX(-0.0747, 1.5480) - 1.0), 0.0,
              0.005, table, "clamp plunges, k = 0.3927: c_l, ours / Theodorsen - 1");
    check_add(list, CHECK_AT_MOST, "",
              cabs(amplitude(sim, CM, omega, 4) * scale / NUM_COMPLEX(0.1024, 0.3870) - 1.0), 0.0,
              0.005, table, "clamp plunges, k = 0.3927: c_m, ours / Theodorsen - 1");
    sim_destroy(sim);
    polar_def_done(&polar);
}

/* In a vacuum, far from resonance, faded in slowly: the motion of the tip over that of the clamp.
 */
static void base_excitation(struct check_list *list)
{
    struct polar_def polar = fixture_linear_polar(2.0 * NUM_PI, NUM_PI / 2.0, 0.0, 1.0);
    struct case_def def;
    const double h = 0.01, wave = 2.5; /* between the first and the second mode */
    wing(1.0, &polar, &def);
    def.aero.dynamic = DYNAMIC_NONE;
    def.flow.density = 0.0;
    def.solver.modes = 10;
    const struct properties *p = &def.beam.section.properties;
    const double omega = num_sq(wave / length) * sqrt(p->ei_flap / p->mass);
    drive_defaults(DRIVE_SINE, &def.beam.root_plunge);
    def.beam.root_plunge.amplitude = h;
    def.beam.root_plunge.frequency = omega / (2.0 * NUM_PI);
    def.beam.root_plunge.ramp = 40.0 * 2.0 * NUM_PI / omega;
    def.solver.time_step = 2.0 * NUM_PI / omega / 400.0;
    def.solver.duration = 52.0 * 2.0 * NUM_PI / omega;
    struct sim *sim = built_run(&def);
    const double c = cos(wave), ch = cosh(wave), s = sin(wave), sh = sinh(wave);
    check_add(list, CHECK_RELATIVE, "", creal(amplitude(sim, PLUNGE, omega, 8)) / h,
              (c + ch) / (1.0 + c * ch), 0.002, "closed form: Euler beam",
              "clamp plunges in a vacuum, beta L = 2.5: tip / clamp");
    /* v = h (cos + cosh)/2 + a (cos - cosh) + b (sin - sinh), free end: a; moment -2 a EI beta^2.
     */
    const double f = 0.5 * h * (ch - c), g = 0.5 * h * (s + sh);
    const double a = (f * (c + ch) - g * (s + sh)) / (num_sq(c + ch) + (s + sh) * (s - sh));
    check_add(list, CHECK_RELATIVE, "N m", creal(amplitude(sim, BENDING, omega, 8)),
              -2.0 * a * p->ei_flap * num_sq(wave / length), 0.002, "closed form: Euler beam",
              "clamp plunges in a vacuum, beta L = 2.5: bending moment in the clamp");
    check_add(list, CHECK_ABSOLUTE, "", sim_result(sim)->verdict == VERDICT_FORCED, 1.0, 0.0,
              "property", "clamp plunges in a vacuum: verdict is forced (1 = yes)");
    sim_destroy(sim);
    def.beam.root_pitch = def.beam.root_plunge;
    def.beam.root_plunge.given = false;
    const double turn = 2.2 / length * sqrt(p->gj / p->torsion_inertia);
    def.beam.root_pitch.frequency = turn / (2.0 * NUM_PI);
    def.beam.root_pitch.ramp = 40.0 * 2.0 * NUM_PI / turn;
    def.solver.time_step = 2.0 * NUM_PI / turn / 400.0;
    def.solver.duration = 52.0 * 2.0 * NUM_PI / turn;
    sim = built_run(&def);
    check_add(list, CHECK_RELATIVE, "", creal(amplitude(sim, TWIST, turn, 8)) / h, 1.0 / cos(2.2),
              0.002, "closed form: bar in torsion",
              "clamp pitches in a vacuum, k L = 2.2: tip / clamp");
    sim_destroy(sim);
    polar_def_done(&polar);
}

static void fill(struct check_list *list)
{
    sharp_edged_gust(list);
    forced_section(list);
    base_excitation(list);
}

const struct check_group group_gusts = {
    .name = "gusts",
    .title = "Gusts and prescribed motion",
    .text =
        "Strip theory with the polar of thin-aerofoil theory. Against Kuessner and Theodorsen the "
        "wing is rigid; its states of the gust's lag are a fit that is within 0.002 of Kuessner's "
        "function. s counts semichords of travel from the leading edge on.",
    .fill = fill,
};
