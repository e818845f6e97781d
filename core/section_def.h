/* core/section_def.h
 * The beam of a case and the sections along it, as given, and what lies between its stations.
 *
 * Plain values; the stations are borrowed. Metres and radians. Coordinates of a section: x towards
 * the leading edge, y up; its origin is on the beam's axis. */
#ifndef AEROM_CORE_SECTION_DEF_H
#define AEROM_CORE_SECTION_DEF_H

#include "core/drive.h"
#include "core/structure/beam.h"
#include "core/structure/properties.h"
#include "core/structure/shape.h"

struct section_def {
    struct shape shape;     /* strip: shape.width is its chord; shape.turn is the twist offset */
    double chord;           /* aerodynamic chord of a box or contour [m], 0: its extent along x */
    double mid_chord;       /* x of mid-chord from the origin, before the turn [m], default 0 */
    enum shear_model shear; /* of the whole beam: that of its first section counts */
    struct properties properties; /* SECTION_PROPERTIES: instead of all above but the shear */
};

/* Fills the defaults of a section of this type. */
void section_def_defaults(enum section_type type, struct section_def *out);

/* Aerodynamic chord and overall height (strip: thickness) of a section [m]; the height is NaN where
 * only properties are known. */
double section_def_chord(const struct section_def *s);
double section_def_height(const struct section_def *s);
/* Mid-chord from the section's origin, along the chord towards the leading edge [m]. */
double section_def_mid_chord(const struct section_def *s);

struct station_def {
    double z; /* [m]; two stations at one z make a jump */
    struct section_def section;
};

struct beam_def {
    double length;                  /* [m] */
    int elements;                   /* default 16 */
    enum root_warping root_warping; /* does the clamp hold the warping? default restrained */
    struct section_def section;     /* of the whole beam when there are no stations */
    int n_station;
    const struct station_def *station; /* borrowed; linear in between, first at 0, last at length */
    int n_mass;
    struct beam_mass mass[LIMIT_MASSES];
    double gravity[3];            /* acceleration along x, y, z [m/s^2], default none */
    struct drive_def root_pitch;  /* of the clamp about the beam's axis, nose-up [rad], none */
    struct drive_def root_plunge; /* of the clamp along y [m], none */
};

/* First section of the beam: of its root. */
const struct section_def *beam_def_root(const struct beam_def *b);
/* The given section that the one at z has its make-up from: type, walls, layups, materials. At a
 * jump the outer side, as in all that follows. */
const struct section_def *beam_def_given_at(const struct beam_def *b, double z);
/* The section at z: that of the beam, or blended between its stations. */
void beam_def_section_at(const struct beam_def *b, double z, struct section_def *out);
/* Aerodynamic chord at z [m]. */
double beam_def_chord_at(const struct beam_def *b, double z);
/* Mid-chord at z from the beam's axis; it turns with the section. */
struct shape_point beam_def_mid_chord_at(const struct beam_def *b, double z);

/* Appends what is wrong with the section of the beam or with its stations. Pointers are those of
 * the contract. */
void beam_def_check_sections(const struct beam_def *b, struct failure_list *out);

#endif
