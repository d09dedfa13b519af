/* Experiments, and what is known of them. Literature's intervals are its own uncertainties where it
 * gives them, else the spread of its sources; the remarks say what they are. */
#include "report/report_validate_rows.h"

#include "report/report_validate_looks.h"
#include "report/report_validate_packing.h"

#include <math.h>

enum { INCLINES = 4, ASPECTS = 5 };
/* A ball that rolls keeps a slip of 1e-4 of its speed; one 1.4 % beyond the limit slides by 2 %. */
static const double SLIDES = 0.005;

static double rolling(const OzTrialNumbers *n)
{
    return n[0][OZ_LOOK_BALL_SPEED];
}

static double sliding(const OzTrialNumbers *n)
{
    return n[INCLINES - 1][OZ_LOOK_BALL_SPEED];
}

static double slide_begins(const OzTrialNumbers *n)
{
    for (int v = 1; v < INCLINES; v++) {
        if (n[v][OZ_LOOK_BALL_SLIP] > SLIDES && n[v - 1][OZ_LOOK_BALL_SLIP] <= SLIDES) {
            return (n[v][OZ_LOOK_BALL_INCLINE] + n[v - 1][OZ_LOOK_BALL_INCLINE]) / 2;
        }
    }
    return NAN;
}

static double overlap_um(const OzTrialNumbers *n)
{
    return 1e6 * n[0][OZ_LOOK_HIT_OVERLAP];
}

static double duration_us(const OzTrialNumbers *n)
{
    return 1e6 * n[0][OZ_LOOK_HIT_DURATION];
}

static double worst_restitution(const OzTrialNumbers *n)
{
    double worst = 0;
    for (int v = 0; v < OZ_TRIAL_VARIANTS; v++) { /* of those that were not run both are 0 */
        worst = fmax(worst, fabs(n[v][OZ_LOOK_HIT_RESTITUTION] - n[v][OZ_LOOK_HIT_ASKED]));
    }
    return worst;
}

static double tangential_45(const OzTrialNumbers *n)
{
    return n[0][OZ_LOOK_HIT_TANGENTIAL];
}

static double tangential_60(const OzTrialNumbers *n)
{
    return n[1][OZ_LOOK_HIT_TANGENTIAL];
}

static double spin_45(const OzTrialNumbers *n)
{
    return n[0][OZ_LOOK_HIT_SPIN];
}

static double density(const OzTrialNumbers *n)
{
    return n[0][OZ_LOOK_PACKING_DENSITY];
}

static double contacts(const OzTrialNumbers *n)
{
    return n[0][OZ_LOOK_PACKING_CONTACTS];
}

static double backbone(const OzTrialNumbers *n)
{
    return n[0][OZ_LOOK_PACKING_BACKBONE];
}

/* Where a parabola in the logarithm of the aspect, by least squares through all of them, is
 * highest. */
static double closest_aspect(const OzTrialNumbers *n)
{
    double m[5] = {0}, r[3] = {0}; /* sums of powers, and of them times the density */
    for (int v = 0; v < ASPECTS; v++) {
        double x = log(n[v][OZ_LOOK_PACKING_ASPECT]), power = 1;
        for (int k = 0; k < 5; k++, power *= x) {
            m[k] += power;
            if (k < 3) {
                r[k] += power * n[v][OZ_LOOK_PACKING_DENSITY];
            }
        }
    }
    double slope = m[0] * (r[1] * m[4] - r[2] * m[3]) - m[1] * (r[0] * m[4] - r[2] * m[2]) +
                   m[2] * (r[0] * m[3] - r[1] * m[2]);
    double bend = m[0] * (m[2] * r[2] - m[3] * r[1]) - m[1] * (m[1] * r[2] - m[3] * r[0]) +
                  m[2] * (m[1] * r[1] - m[2] * r[0]);
    return bend < 0 ? exp(-slope / (2 * bend)) : NAN;
}

static double floor_share(const OzTrialNumbers n)
{
    return n[OZ_LOOK_SILO_FLOOR] / n[OZ_LOOK_SILO_LOOKS];
}

/* What twice the filling adds to the floor's load. */
static double saturation(const OzTrialNumbers *n)
{
    return floor_share(n[1]) / floor_share(n[0]);
}

/* K, horizontal over vertical stress, from the load where it is saturated: the weight of a height
 * D / (4 mu K). */
static double janssen(const OzTrialNumbers *n)
{
    return n[1][OZ_LOOK_SILO_COLUMN] / floor_share(n[1]);
}

static double haff(const OzTrialNumbers *n)
{
    const double *s = n[0];
    double count = s[OZ_LOOK_GAS_COUNT];
    double slope = (count * s[OZ_LOOK_GAS_PRODUCT] - s[OZ_LOOK_GAS_TIME] * s[OZ_LOOK_GAS_SLOW]) /
                   (count * s[OZ_LOOK_GAS_TIME2] - s[OZ_LOOK_GAS_TIME] * s[OZ_LOOK_GAS_TIME]);
    return slope / s[OZ_LOOK_GAS_THEORY];
}

static double slope_of(const OzTrialNumbers n)
{
    return n[OZ_LOOK_DRUM_SLOPE] / n[OZ_LOOK_DRUM_LOOKS];
}

static double drum_slope(const OzTrialNumbers *n)
{
    return slope_of(n[1]);
}

static double drum_rise(const OzTrialNumbers *n)
{
    return slope_of(n[1]) - slope_of(n[0]);
}

static double heap_slope(const OzTrialNumbers *n)
{
    return n[1][OZ_LOOK_HEAP_SLOPE];
}

static double heap_rise(const OzTrialNumbers *n)
{
    return n[1][OZ_LOOK_HEAP_SLOPE] - n[0][OZ_LOOK_HEAP_SLOPE];
}

/* kg/s */
static double outflow(const OzTrialNumbers n)
{
    return (n[OZ_LOOK_HOPPER_AFTER] - n[OZ_LOOK_HOPPER_BEFORE]) /
           (n[OZ_LOOK_HOPPER_TO] - n[OZ_LOOK_HOPPER_FROM]);
}

static double beverloo_factor(const OzTrialNumbers *n)
{
    double rate = n[0][OZ_LOOK_HOPPER_DENSITY] * sqrt(9.81) * pow(n[0][OZ_LOOK_HOPPER_FREE], 2.5);
    return outflow(n[0]) / rate;
}

static double beverloo_power(const OzTrialNumbers *n)
{
    return log(outflow(n[0]) / outflow(n[1])) /
           log(n[0][OZ_LOOK_HOPPER_FREE] / n[1][OZ_LOOK_HOPPER_FREE]);
}

const OzValidation oz_report_validate_rows_all[] = {
    {"incline",
     .trial = {"validation/incline",
               1,
               1,
               {{"gravity=[5.047203, 0, -8.412006]"},
                {"gravity=[7.054979, 0, -6.816405]"},
                {"gravity=[7.151523, 0, -6.715045]"},
                {"gravity=[8.162413, 0, -5.441609]"}},
               oz_report_validate_looks_ball},
     .known = {{"ball rolls down an incline, a / g sin(theta)", "", 0.7135, 0.715,
                "rigid body: 5/7", "+- 0.1 %: friction is a spring, and yields at the start",
                rolling},
               {"ball slides down, tan(theta) = 5 mu, the same", "", 0.7992, 0.8008,
                "rigid body: 1 - mu / tan(theta)", "+- 0.1 %", sliding},
               {"it begins to slide at tan(theta) / mu", "", 3.45, 3.55, "rigid body: 7/2",
                "between the steepest incline that it rolls down and the next", slide_begins}}},
    {"chung_ooi_1", .trial = {"report/chung_ooi_1", 1, 600, .look = oz_report_validate_looks_hit},
     .known = {{"two glass spheres: greatest overlap", "um", 273.8, 274.4,
                "Chung & Ooi 2011, 1 (Hertz)", "274.1 +- 0.1 %", overlap_um},
               {"duration of the hit", "us", 40.30, 40.38, "Chung & Ooi 2011, 1 (Hertz)",
                "40.34 +- 0.1 %", duration_us}}},
    {"chung_ooi_2", .trial = {"report/chung_ooi_2", 1, 600, .look = oz_report_validate_looks_hit},
     .known = {{"aluminium sphere on a plane: greatest overlap", "um", 49.67, 49.77,
                "Chung & Ooi 2011, 2 (Hertz)", "49.72 +- 0.1 %", overlap_um},
               {"duration of the hit", "us", 730.9, 732.4, "Chung & Ooi 2011, 2 (Hertz)",
                "731.6 +- 0.1 %", duration_us}}},
    {"chung_ooi_3",
     .trial = {"report/chung_ooi_3",
               1,
               1,
               {{"contact.restitution=0.2"},
                {"contact.restitution=0.4"},
                {"contact.restitution=0.6"},
                {"contact.restitution=0.8"},
                {"contact.restitution=1"}},
               oz_report_validate_looks_hit},
     .known = {{"restitution 0.2 to 1: largest error", "", 0, 0.002, "Chung & Ooi 2011, 3",
                "0 +- 0.002, of the step", worst_restitution}}},
    {"chung_ooi_4",
     .trial = {"report/chung_ooi_4",
               1,
               1,
               {{"grains.0.velocity=[2.757716446627535, 0, -2.757716446627535]"},
                {"grains.0.velocity=[3.37749907475931, 0, -1.95]"}},
               oz_report_validate_looks_hit},
     .known = {{"oblique hit, 45 degrees: tangential restitution", "", 0.8170, 0.8187,
                "Chung & Ooi 2011, 4 (sliding)", "0.8178 +- 0.1 %", tangential_45},
               {"60 degrees: the same", "", 0.8939, 0.8957, "Chung & Ooi 2011, 4 (sliding)",
                "0.8948 +- 0.1 %", tangential_60},
               {"45 degrees: spin", "rad/s", 500.8, 503.9, "Chung & Ooi 2011, 4 (sliding)",
                "502.3 +- 0.3 %: the lever is shorter by the overlap", spin_45}}},
    {"packing", .trial = {"validation/packing", 5, 1, .look = oz_report_validate_packing_look},
     .known = {{"spheres without friction: density", "", 0.634, 0.644, "Agnolin & Roux 2007: 0.639",
                "+- 0.005: what authors differ by", density},
               {"contacts of a sphere", "", 5.8, 6.2, "Silbert et al. 2002: 6",
                "isostatic where hard; +- 0.2: overlaps of 1e-4 add some", contacts}}},
    {"packing_rods",
     .trial = {"validation/packing",
               4,
               1,
               {{"grains.0.aspect=0.45", "grains.0.count=2000", "walls.1.diameter=14e-3"},
                {"grains.0.aspect=0.15", "grains.0.count=2000", "walls.1.diameter=14e-3"},
                {"grains.0.aspect=0.3", "grains.0.count=2000", "walls.1.diameter=14e-3"},
                {"grains.0.aspect=0.7", "grains.0.count=2000", "walls.1.diameter=15e-3"},
                {"grains.0.aspect=1", "grains.0.count=2500", "walls.1.diameter=17e-3"}},
               oz_report_validate_packing_look},
     .known =
         {{"spherocylinders of aspect 0.45: density", "", 0.695, 0.731,
           "Imaz Gonzalez et al. 2023: 0.721",
           "0.695 by Williams & Philipse 2003, 0.731 by Baule et al. 2013", density},
          {"aspect at which they are densest", "", 0.35, 0.55, "Imaz Gonzalez et al. 2023: 0.45",
           "0.4 by Williams & Philipse 2003; 0.45 +- 0.05; of a parabola in log(aspect), 0.15 to 1",
           closest_aspect}}},
    {"packing_rough",
     .trial = {"validation/packing",
               4,
               1,
               {{"contact.friction=0.3", "settle.drag=10"}},
               oz_report_validate_packing_look},
     .known = {{"spheres with friction 0.3: density", "", 0.588, 0.598,
                "Agnolin & Roux 2007: 0.593",
                "+- 0.005; drag 70 /s instead of 10, a thicker fluid, leaves 0.581", density},
               {"contacts of a sphere that bears", "", 4.4, 4.6, "Agnolin & Roux 2007: 4.5",
                "+- 0.1", backbone,
                "softness: 4.8 at a third of the contact time; theirs is pressed evenly, not by "
                "weight"}}},
    {"silo",
     .trial = {"validation/silo",
               8,
               40,
               {{"grains.0.count=1300"}, {"grains.0.count=2600"}},
               oz_report_validate_looks_silo},
     .known = {{"silo filled twice as high: load of the floor", "", 0.9, 1.1,
                "Janssen 1895: 1 (saturated)",
                "+- 10 %, by which fillings differ; 2 without friction", saturation},
               {"K, horizontal over vertical stress", "", 0.44, 1.1, "Rankine 1857; Janssen 1895",
                "active state of spheres, 23 degrees, to a little beyond isotropic", janssen}}},
    {"cooling", .trial = {"validation/cooling", 3, 100, .look = oz_report_validate_looks_gas},
     .known = {{"free cooling, rate over that of kinetic theory", "", 0.95, 1, "Haff 1983; Enskog",
                "a little slower: velocities are correlated (Kawahara & Nakanishi 2003)", haff}}},
    {"drum",
     .trial = {"validation/drum",
               3,
               40,
               {{"contact.friction=0.1", "walls.0.contact.friction=0.5"},
                {"contact.friction=0.5", "walls.0.contact.friction=0.5"}},
               oz_report_validate_looks_drum},
     .known = {{"angle of repose in a slow drum, friction 0.5", "degrees", 20.9, 28,
                "Jop et al. 2006; GDR MiDi 2004", "glass beads, at rest to in a thin flow",
                drum_slope},
               {"what it is more than with friction 0.1", "degrees", 1, 15, "Zhou et al. 2001",
                "grows with friction; by how much hangs on the set-up", drum_rise}}},
    {"hopper",
     .trial = {"validation/hopper",
               3,
               130,
               {{"walls.0.diameter=[8e-3, 18e-3]"}, {"walls.0.diameter=[6e-3, 18e-3]"}},
               oz_report_validate_looks_hopper},
     .known = {{"hopper: W / (rho sqrt(g) (D - 1.4 d)^2.5)", "", 0.55, 0.65,
                "Beverloo et al. 1961: 0.58",
                "0.55 to 0.65 by material (Nedderman 1992); friction 0.2, as glass: 0.54 at 0.3, "
                "0.50 at 0.5",
                beverloo_factor},
               {"power of D - 1.4 d", "", 2.35, 2.7, "Beverloo et al. 1961: 2.5",
                "2.35 to 2.7 for k from 1.2 to 1.7 in place of 1.4", beverloo_power}}},
    {"heap",
     .trial = {"validation/heap",
               3,
               1,
               {{"contact.friction=0.1"}, {"contact.friction=0.5"}},
               oz_report_validate_looks_heap},
     .known = {{"slope of a heap on a rough floor, friction 0.5", "degrees", 19.3, 28,
                "Silbert et al. 2001; Weinhart et al. 2012",
                "where flows of such spheres stop: deep ones at 19.3, of two to four diameters at "
                "28 to 25",
                heap_slope},
               {"what it is more than with friction 0.1", "degrees", 1, 15, "Zhou et al. 2001",
                "grows with friction; by how much hangs on the set-up", heap_rise}}},
    {NULL},
};
