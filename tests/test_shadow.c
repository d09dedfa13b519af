/* Shadows of surfaces written by hand: none on a plane alone, a soft one beside what stands before
 * it.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "draw/shadow.h"

enum { SIDE = 260, RADIUS = 40, EDGE = 100 };

static const float white[3] = {1, 1, 1};
static const double DEEP = 0.02; /* a grain's radius, depth */

/* A plane that slants by this depth a pixel; with a bar of two radii's thickness up to EDGE. */
static OzShadowRoom shade(OzDrawnRoom *room, double slant, bool has_bar)
{
    OzShadow shadow = oz_shadow_make(RADIUS, DEEP);
    OzShadowRoom found = {0};
    OzDrawn drawn;
    OzBox box = {0, 0, SIDE, SIDE};
    assert_int_equal(oz_drawn_open(&drawn, room, &box, white), OZ_OK);
    for (int y = 0; y < SIDE; y++) {
        for (int x = 0; x < SIDE; x++) {
            double depth = 0.5 + slant * x - (has_bar && x < EDGE ? 2 * DEEP : 0);
            drawn.depth[(ptrdiff_t)y * drawn.stride + x] = (float)depth;
        }
    }
    assert_int_equal(oz_shadow_find(&found, &shadow, &drawn), OZ_OK);
    return found;
}

static float shade_at(const OzShadowRoom *found, int x, int y)
{
    return found->shade[(ptrdiff_t)(y / 2) * found->stride + x / 2];
}

/* Up to the roundings of depths, which are floats: 1e-7 of a depth that darkens fully at 0.03. */
static void a_plane_has_no_shadow(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++) {
        OzDrawnRoom room = {0};
        OzShadowRoom found = shade(&room, 4e-4 * i, false);
        for (int x = 0; x < SIDE; x += 2) {
            assert_true(shade_at(&found, x, SIDE / 2) < 1e-4f);
        }
        oz_shadow_free(&found);
        oz_drawn_free(&room);
    }
}

/* The dark half of the pairs reaches it beside the edge; it ends 1.2 radii away and two half-size
 * pixels more, of smoothing; what casts it stays bright up to its edge. */
static void a_shadow_is_beside_what_casts_it(void **state)
{
    (void)state;
    OzDrawnRoom room = {0};
    OzShadowRoom found = shade(&room, 0, true);
    assert_true(shade_at(&found, EDGE + 2, SIDE / 2) > 0.3f);
    assert_true(shade_at(&found, EDGE - 2, SIDE / 2) < 1e-4f);
    assert_true(shade_at(&found, EDGE + RADIUS * 6 / 5 + 6, SIDE / 2) < 1e-4f);
    oz_shadow_free(&found);
    oz_drawn_free(&room);
}

/* Twelve pairs copy the edge onto the plane twelve times, each a step of a twelfth. Smoothing
 * spreads a step over five pixels, in which five more may lie; without it there are steps of
 * several. */
static void a_shadow_fades_without_edges(void **state)
{
    (void)state;
    OzDrawnRoom room = {0};
    OzShadowRoom found = shade(&room, 0, true);
    for (int x = EDGE; x < SIDE - 4; x += 2) {
        float step = shade_at(&found, x, SIDE / 2) - shade_at(&found, x + 2, SIDE / 2);
        assert_true(step >= -1e-6f && step < 1.0f / OZ_SHADOW_PAIRS + 1e-6f);
    }
    oz_shadow_free(&found);
    oz_drawn_free(&room);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_plane_has_no_shadow),
        cmocka_unit_test(a_shadow_is_beside_what_casts_it),
        cmocka_unit_test(a_shadow_fades_without_edges),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
