#!/bin/sh
# Adds a row of each list in a scratch copy of the sources, exactly as README's table says: a scene key, a contact law,
# an integrator, a wall, a shape of trigrains and an observable. A row alone must not compile; with what the table asks
# for, the program must build and each of the six must act, by numbers known in closed form.
#   tests/test_recipes.sh [FOLDER]   works in FOLDER, which is left there; without, in a temporary one
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
work=${1:-$(mktemp -d)}
[ $# -gt 0 ] || trap 'rm -rf "$work"' EXIT
mkdir -p "$work/source/scenes" "$work/temporary"
# Kernels of the copy would fill the user's cache for good.
export POCL_CACHE_DIR="$work/kernels" TMPDIR="$work/temporary"
cp -R "$root/CMakeLists.txt" "$root/host" "$root/kernels" "$root/shaders" "$work/source"
cp "$root/scenes/an6.yaml" "$work/source/scenes"
cd "$work/source"

fail() {
    printf 'test_recipes: %s\n' "$*" >&2
    exit 1
}

# put before|after FILE TEXT: writes standard input before or after the first line that holds TEXT.
put() {
    cat >"$work/new"
    grep -qF -- "$3" "$2" || fail "$2 has no line with: $3"
    WHERE=$1 TEXT=$3 NEW="$work/new" perl -i -pe '
        BEGIN { local $/; open my $f, "<", $ENV{NEW}; $new = <$f>; }
        if (!$done && index($_, $ENV{TEXT}) >= 0) {
            $_ = $ENV{WHERE} eq "before" ? $new . $_ : $_ . $new;
            $done = 1;
        }' "$2"
}

# refuses LIST FILE.c NAME: the row of that list is there, what it names is not.
refuses() {
    if ${CC:-cc} -std=c17 -fsyntax-only -D_GNU_SOURCE -Ihost -I. "$2" 2>"$work/log"; then
        fail "$2 compiles with a row of $1 that it does not serve"
    fi
    grep -q "$3" "$work/log" || { cat "$work/log"; fail "$2: another error"; }
}

# The rows.
put after kernels/laws.h 'X(HOOKE, hooke' <<'ROW'
    X(BRAKE, brake, "brake", 1, PER_TIME2, PER_TIME) \
ROW
put after kernels/integrators.h 'X(SYMPLECTIC_EULER,' <<'ROW'
    X(MEAN_EULER, mean_euler, "mean-euler", "", 0.5, 0) \
ROW
put after kernels/walls.h 'X(PLANE,' <<'ROW'
    X(FUNNEL, funnel, "funnel", 0, 0) \
ROW
put after host/scene/scene_types.h 'X(SQUARE,' <<'ROW'
    X(RHOMBUS, rhombus, "rhombus") \
ROW
put after host/observe/observables.c '{"time", "s"' <<'ROW'
    {"lowest", "m", "height of the lowest grain's centre", RODS, ALWAYS, false, lowest, 0},
ROW
put before host/scene/rows_walls.h '{"walls[].motion", OF(SECTION)' <<'ROW'
    {"walls[].half_angle", NUMBER(1, 89, "degrees"), WALL(half_angle), DEGREES, .kinds = FUNNEL,
     DEFAULT("45"), SOLID, .help = "of the funnel"},
ROW

put after host/scene/scene_types.h 'double diameter;            /* m, cylinder' <<'CODE'
    double half_angle; /* rad, funnel */
CODE
refuses OZ_LAWS host/model/contact.c constants_brake
refuses OZ_LAWS host/model/predict.c repulsion_brake
refuses OZ_INTEGRATORS host/model/predict.c step_mean_euler
refuses OZ_INTEGRATORS host/model/calibrate.c invert_mean_euler
refuses OZ_WALLS host/model/fill_region.c bound_by_funnel
refuses OZ_WALLS host/scene/wall_shape.c oz_wall_funnel
refuses OZ_SHAPES host/model/shape.c make_rhombus
refuses columns host/observe/observables.c lowest

# A law: hooke's, whose dashpot acts while the overlap grows.
cat >kernels/contact_brake.h <<'CODE'
#pragma once
#include "kernels/contact_hooke.h"
OZ_INLINE OzResponse oz_contact_brake(OzContact c, OzLawConstants law)
{
    OzResponse out = oz_contact_hooke(c, law);
    out.dashpot = c.rate > REAL(0.0) ? out.dashpot : REAL(0.0);
    return out;
}
CODE
echo '#include "kernels/contact_brake.h"' | put before kernels/contact_law.h '#include "kernels/contact_hertz.h"'
put before host/model/contact.c '#define ROW(NAME' <<'CODE'
static OzContactConstants constants_brake(const OzContactValues *one, const OzContactValues *other)
{
    return constants_hooke(one, other);
}
CODE
put before host/model/predict.c '#define ROW(NAME' <<'CODE'
static double repulsion_brake(const Hit *hit, double x, double rate)
{
    return hit->stiffness * x + (rate > 0 ? hit->damping * rate : 0);
}
CODE
sed -i 's/\.laws = HOOKE/.laws = BRAKE | HOOKE/' host/scene/rows.c

# An integrator: places move with the mean of the old velocity and the new one, exact in free fall.
cat >kernels/integrate_mean_euler.h <<'CODE'
#pragma once
#include "kernels/body.h"
OZ_INLINE void oz_mean_euler_after(OzBody *body, OzShape shape, OzLoad load, real dt, scalar inverse_unit)
{
    OzVec3 u = oz_quaternion_axis(body->turn), before = body->velocity;
    body->velocity = oz_along(before, dt * shape.inverse_mass, load.force);
    body->spin = oz_body_kick_spin(body->spin, load.torque, u, shape, dt);
    oz_fixed_position_move(&body->position, &body->rest,
                           oz_scale(oz_add(before, body->velocity), REAL(0.5) * dt), inverse_unit);
    oz_body_turn(body, body->spin, shape, dt);
}
CODE
echo '#include "kernels/integrate_mean_euler.h"' | put before kernels/integrate.h '#include "kernels/integrate_s'
put before host/model/predict.c 'static const struct {' <<'CODE'
static void step_mean_euler(Hit *hit)
{
    double acceleration = hit_acceleration(hit, hit->rate);
    hit->overlap += hit->rate + 0.5 * acceleration;
    hit->rate += acceleration;
}

static void polynomial_mean_euler(double K, double G, double c[3])
{
    c[2] = 0.5 * K + G - 2;
    c[1] = 1 - G + 0.5 * K;
    c[0] = 0;
}

static double limit_mean_euler(double kappa, double gamma)
{
    return fmin(2 * gamma / kappa, 2 / gamma);
}
CODE
put before host/model/calibrate.c 'static void (*const inverses' <<'CODE'
static void invert_mean_euler(double rho, double theta, double *stiffness, double *damping)
{
    *stiffness = 1 - 2 * rho * cos(theta) + rho * rho;
    *damping = 1 - rho * rho + 0.5 * *stiffness;
}
CODE

# A wall: the inside of an endless upright cone, its tip below.
cat >kernels/wall_funnel.h <<'CODE'
#pragma once
#include "kernels/wall_shape.h"
OZ_INLINE OzWallDistance oz_wall_funnel(OzVec3 from, OzWallShape wall)
{
    OzWallDistance at;
    real r2 = from.x * from.x + from.y * from.y;
    real out = oz_inverse_root(oz_larger(r2, REAL(OZ_TINY)));
    real cosine = REAL(wall.normal[0]), sine = REAL(wall.normal[2]);
    at.normal = oz_vec3(-cosine * from.x * out, -cosine * from.y * out, sine);
    at.distance = sine * from.z - cosine * r2 * out;
    return at;
}
CODE
echo '#include "kernels/wall_funnel.h"' | put before kernels/wall.h '#include "kernels/wall_band.h"'
put before host/scene/wall_shape.c '/* The one side of a wall' <<'CODE'
static void shape_funnel(OzWallShape *shape, const OzWall *wall)
{
    shape_plane(shape, wall); /* its point */
    shape->normal[0] = cos(wall->half_angle);
    shape->normal[2] = sin(wall->half_angle);
}
CODE
put before host/model/fill_region.c '#define ROW(NAME' <<'CODE'
static void bound_by_funnel(OzFillRegion *region, const OzWall *wall)
{
    region->low[2] = fmax(region->low[2], wall->point[2]);
    region->walled_low[2] = true;
}
CODE

# A shape: half as high as it is wide, of four triangles about the middle.
put before host/model/shape.c 'static OzStatus make_polygon' <<'CODE'
static OzStatus make_rhombus(OzTriangleSet *set, const OzScene *scene, const OzPopulation *population,
                             OzRandom *random)
{
    (void)scene;
    double edge = draw(random, &population->edge);
    OzStatus status = oz_triangle_set_create(set, 5, 4);
    for (int i = 0; status == OZ_OK && i < 4; i++) {
        put(set, i, 0.5 * PI * i, i % 2 ? edge / 4 : edge / 2);
    }
    return status == OZ_OK ? fan(set) : status;
}
CODE
sed -i 's/\.shapes = SHAPE_SQUARE/.shapes = SHAPE_SQUARE | SHAPE_RHOMBUS/' host/scene/rows.c

# An observable.
put before host/observe/observables.c 'static bool density(' <<'CODE'
static bool lowest(const OzObservation *o, double *value)
{
    *value = INFINITY;
    for (int64_t i = 0; i < o->snapshot->count; i++) {
        *value = fmin(*value, o->snapshot->position[3 * i + 2]);
    }
    return o->snapshot->count > 0;
}
CODE

cmake -S . -B "$work/build" -DCMAKE_BUILD_TYPE=Debug -DCMAKE_C_FLAGS_DEBUG=-O0 -DBUILD_TESTING=OFF \
    >"$work/log" 2>&1 || { cat "$work/log"; fail 'cmake'; }
cmake --build "$work/build" --parallel 2 --target orzo >"$work/log" 2>&1 || { cat "$work/log"; fail 'does not build'; }
# What might be cut off is seen through only with -O2.
grep 'warning:' "$work/log" | grep -v 'format-truncation' && fail 'builds with warnings'

# A sphere falls freely; another one flies down into the funnel.
cat >"$work/funnel.yaml" <<'SCENE'
model: rods
precision: double
integrator: mean-euler
time: {step: 1e-6, duration: 4e-3}
contact: {law: brake, contact_time: 4e-4, restitution: 0.25, friction: 0}
grains:
  - {kind: single, diameter: 1e-3, position: [0, 0, 0.5]}
  - {kind: single, diameter: 1e-3, position: [5e-3, 0, 8e-3], velocity: [0, 0, -1]}
walls: [{kind: funnel, half_angle: 45}]
SCENE
# A rhombus without a load.
cat >"$work/rhombus.yaml" <<'SCENE'
model: trigrains
time: {step: 1e-6, duration: 1e-5}
gravity: [0, 0]
grains: [{kind: single, shape: rhombus, edge: 6e-3, position: [0, 0], velocity: [1, 0]}]
SCENE
for scene in funnel rhombus; do
    "$work/build/orzo" run "$work/$scene.yaml" -o "$work/$scene" --no-video >"$work/log" 2>&1 ||
        { cat "$work/log"; fail "$scene.yaml"; }
done
grep -q 'half_angle: 45' "$work/funnel/scene.yaml" || fail 'the new key is not written back'
"$work/build/orzo" keys half_angle | grep -q 'of the funnel' || fail 'keys does not know the new one'

cat >"$work/judge.pl" <<'CODE'
# The last row of a table, by column.
sub last_row {
    open my $file, '<', $_[0] or die "$_[0]: $!\n";
    my @lines = grep { !/^#/ } <$file>;
    chomp @lines;
    my (%row, @names);
    @names = split /,/, $lines[0];
    my @rows = map { my %r; @r{@names} = split /,/, $_, -1; \%r } @lines[1 .. $#lines];
    return $_[1] ? @rows : $rows[-1];
}
sub near {
    my ($what, $value, $right, $tolerance) = @_;
    printf "%s: %.9g, expected %.9g\n", $what, $value, $right;
    $wrong = 1 unless abs($value - $right) <= $tolerance * abs($right);
}
my ($falls, $hits) = last_row("$ARGV[0]/funnel/final.csv", 1);
# After N steps Euler has fallen by g dt^2 N (N - 1) / 2, symplectic Euler by N (N + 1) / 2, the mean by N^2 / 2: a
# 4000th apart.
near('integrator: fall', 0.5 - $falls->{z}, 0.5 * 9.81 * 4e-3**2, 5e-5);
# Damped oscillation to its deepest point, then an undamped half: e = exp(-b t1), b / w = -ln(0.25) / pi, t1 =
# atan(w / b) / w. The funnel's normal turns (1 + e) / 2 of the speed outwards, which is 1 m/s and what a fall adds until
# the sphere touches, its centre 0.5 mm x sqrt(2) above the slope. Without the wall vx is 0, with hooke's law -0.64.
# Gravity acts for the contact time, too, 0.3 % of the speed; 400 steps in a contact add 0.3 %.
my $ratio = log(4) / (4 * atan2(1, 1));
my $e = exp(-$ratio * atan2(1, $ratio));
my $speed = sqrt(1 + 2 * 9.81 * (8e-3 - 5e-3 - 0.5e-3 * sqrt(2)));
near('wall and law: vx', $hits->{vx}, -$speed * (1 + $e) / 2, 0.01);
# Written with nine digits or more.
my $least = $falls->{z} < $hits->{z} ? $falls->{z} : $hits->{z};
near('observable: lowest', last_row("$ARGV[0]/funnel/series.csv")->{lowest}, $least, 1e-7);
# 4 kg/m^2 on a quarter of the edge's square; beams at rest.
near('shape: kinetic', last_row("$ARGV[0]/rhombus/series.csv")->{kinetic}, 0.5 * 4 * 6e-3**2 / 4, 1e-7);
exit($wrong // 0);
CODE
perl "$work/judge.pl" "$work" || fail 'a new row does not act as it should'
