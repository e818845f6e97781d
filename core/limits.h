/* core/limits.h
 * Every maximum of the physics. */
#ifndef AEROM_CORE_LIMITS_H
#define AEROM_CORE_LIMITS_H

enum {
    LIMIT_NAME = 64,              /* bytes of a name with its terminating zero */
    LIMIT_HASH = 65,              /* 256 bits in hexadecimal with its terminating zero */
    LIMIT_PLIES = 64,             /* plies of one laminate */
    LIMIT_LAYUPS = 8,             /* layups of one section */
    LIMIT_POINTS = 64,            /* points of a contour section */
    LIMIT_WALLS = 64,             /* walls of a contour section */
    LIMIT_STATIONS = 12,          /* spanwise stations of a beam */
    LIMIT_LOADS = 16,             /* point loads, and line loads, of a static case */
    LIMIT_STRESS_POSITIONS = 16,  /* positions at which stresses are asked for */
    LIMIT_MASSES = 16,            /* lumped masses of a beam */
    LIMIT_ELEMENTS = 256,         /* beam elements = aerodynamic stations */
    LIMIT_STATES = 1200,          /* states of the linearised system: minutes of eigenvalues */
    LIMIT_SPEEDS = 1000,          /* speeds of a stability case */
    LIMIT_MODES = 64,             /* modes kept */
    LIMIT_CONTOUR_ELEMENTS = 256, /* elements along one wall of a section */
    LIMIT_SECTION_ELEMENTS = 512, /* elements of all walls of a section */
    LIMIT_POLAR_ANGLES = 2048,
    LIMIT_POLAR_PLUNGES = 64,
    LIMIT_NET_INPUTS = 24,
    LIMIT_NET_HIDDEN = 512,
    LIMIT_NET_OUTPUTS = 3,
    LIMIT_STEPS = 10000000,         /* time steps of one run */
    LIMIT_CHANNEL_COLUMNS = 512,    /* recorded columns, vector channels counted by component */
    LIMIT_SERIES_VALUES = 20000000, /* recorded values of one run: 160 MB */
    LIMIT_ROOTS = 16,               /* identified roots reported per signal */
    LIMIT_TABLE = 256,              /* rows of a gust or of a prescribed motion */
    LIMIT_LOAD_ORDER = 4            /* order of the load extrapolation */
};

#endif
