/* Spherocylinders (spheres when half_shaft is 0) as ray-cast impostors with exact depth, drawn or not
 * by the pixel's middle; alpha says where beside it the outline runs (lens.glsl), for smoothing it
 * later. OZ_SLICED cuts them by a plane and fills the cross-section. OZ_OUTLINED draws
 * a faint line along the inside of their outlines, a ninth of the radius wide, at least 1.5 pixels, and
 * nothing else. */

uniform float pixel; /* view units per pixel at the middle's depth */

#ifdef OZ_VERTEX
layout(location = 0) in vec4 centre_radius;
layout(location = 1) in vec4 axis_half;
layout(location = 2) in vec4 rgb;

flat out vec4 capsule_centre;
flat out vec4 capsule_axis;
flat out vec3 capsule_rgb;
out vec2 offset; /* of this corner from the centre, in the plane z = centre.z */

/* A rectangle in the plane z = centre.z that hides the whole capsule from the eye: both end spheres are
 * projected onto the plane and covered with a margin of 2 % (their outline is an ellipse off the
 * picture's middle) and half a pixel (of quads that share a slope). */
void main()
{
    vec3 centre = centre_radius.xyz;
    vec3 reach = axis_half.xyz * axis_half.w;
    float plane_distance = lens.z - centre.z;
    vec2 near_scale = plane_distance / (plane_distance - abs(reach.z) * vec2(1.0, -1.0));
    vec3 toward = reach.z >= 0.0 ? reach : -reach;
    vec2 ends[2];
    ends[0] = (centre.xy + toward.xy) * near_scale.x - centre.xy;
    ends[1] = (centre.xy - toward.xy) * near_scale.y - centre.xy;
    float margin = 1.02 * centre_radius.w * plane_distance
        / (plane_distance - abs(reach.z) - centre_radius.w) + 0.5 * pixel;
    vec2 along = ends[0] - ends[1];
    along = dot(along, along) > 1e-14 ? normalize(along) : vec2(1.0, 0.0);
    vec2 across = vec2(-along.y, along.x);
    float low = min(dot(ends[0], along), dot(ends[1], along)) - margin;
    float high = max(dot(ends[0], along), dot(ends[1], along)) + margin;
    float side_low = min(dot(ends[0], across), dot(ends[1], across)) - margin;
    float side_high = max(dot(ends[0], across), dot(ends[1], across)) + margin;
    offset = along * ((gl_VertexID & 1) == 0 ? low : high)
        + across * ((gl_VertexID & 2) == 0 ? side_low : side_high);
    capsule_centre = centre_radius;
    capsule_axis = axis_half;
    capsule_rgb = rgb.rgb;
    gl_Position = clip_of(vec3(centre.xy + offset, centre.z));
}
#endif

#ifdef OZ_FRAGMENT
uniform vec4 plane; /* the cut: normal into the half that is kept, and its offset */

flat in vec4 capsule_centre;
flat in vec4 capsule_axis;
flat in vec3 capsule_rgb;
in vec2 offset;
out vec4 colour;

const vec3 LIGHT = vec3(-0.41, 0.58, 0.70);
const vec3 HALFWAY = vec3(-0.225, 0.318, 0.921); /* between the light and the eye */

/* The eye's ray through this pixel, longer than 1 by less than a hundredth. */
vec3 ray()
{
    return vec3((capsule_centre.xy + offset) / (lens.z - capsule_centre.z), -1.0);
}

/* Where the ray q + t d (q relative to the centre) meets the capsule, which = -1 for entering and 1 for
 * leaving; beside the capsule, where it comes closest. The infinite cylinder is met first; if that is
 * beyond an end, the sphere there decides. spine receives the nearest point's place on the axis, miss
 * how far the ray passes beside the surface, negative when it hits. */
float meet(vec3 q, vec3 d, float which, out float spine, out float miss)
{
    vec3 u = capsule_axis.xyz;
    float h = capsule_axis.w, r = capsule_centre.w;
    float uq = dot(u, q), ud = dot(u, d), qd = dot(q, d), qq = dot(q, q), dd = dot(d, d);
    float inverse = 1.0 / max(dd - ud * ud, 1e-9);
    float b = (qd - uq * ud) * inverse, depth = b * b - (qq - uq * uq - r * r) * inverse;
    float t = which * sqrt(max(depth, 0.0)) - b;
    float y = uq + t * ud;
    float thickness = depth * (dd - ud * ud);
    spine = clamp(y, -h, h);
    if (y != spine) {
        b = (qd - spine * ud) / dd;
        thickness = dd * b * b - (qq - 2.0 * spine * uq + spine * spine - r * r);
        t = which * sqrt(max(thickness / dd, 0.0)) - b;
    }
    miss = sqrt(max(r * r - thickness, 0.0)) - r;
    return t;
}

/* Pixels from here, along rows or along columns, to where a distance that is negative within becomes
 * zero. */
vec2 way_out(float beyond)
{
    vec2 slope = vec2(dFdx(beyond), dFdy(beyond));
    return abs(slope.x) > abs(slope.y) ? vec2(-beyond / slope.x, 0.0)
                                       : vec2(0.0, -beyond / (slope.y == 0.0 ? 1e-9 : slope.y));
}

/* Soft light from the upper left, a sky from above, edges darkened so that each rod stands out. */
vec3 shade(vec3 n, vec3 d)
{
    float facing = clamp(-dot(n, d), 0.0, 1.0);
    float light = 0.58 + 0.42 * max(dot(n, LIGHT), 0.0) + 0.10 * n.y;
    float shine = max(dot(n, HALFWAY), 0.0);
    shine *= shine;
    shine *= shine;
    shine *= shine;
    shine *= shine;
    float rim = facing * (2.0 - facing);
    return mix(capsule_rgb, vec3(1.0), 0.05) * light * mix(0.42, 1.10, rim) + 0.22 * shine * shine;
}

/* Flat, with a dark outline a seventh of the radius wide, at least a pixel. p lies on the section; its
 * distance from the outline, within the plane, is that from the surface over the slope there. */
vec3 shade_section(vec3 p)
{
    float spine = clamp(dot(p, capsule_axis.xyz), -capsule_axis.w, capsule_axis.w);
    vec3 away = p - spine * capsule_axis.xyz;
    float reach = max(length(away), 1e-9), lean = dot(away, plane.xyz) / reach;
    float inside = (capsule_centre.w - reach) / sqrt(max(1.0 - lean * lean, 1e-6));
    float width = max(0.14 * capsule_centre.w, pixel);
    float fill = clamp((inside - width) / pixel + 0.5, 0.0, 1.0);
    return mix(0.40 * capsule_rgb, mix(capsule_rgb, vec3(1.0), 0.08), fill);
}

#ifdef OZ_OUTLINED
void main()
{
    float spine, miss;
    meet(vec3(offset, 0.0), ray(), -1.0, spine, miss);
    float inside = -miss / pixel;
    float width = max(0.11 * capsule_centre.w / pixel, 1.5);
    float share = clamp(inside + 0.5, 0.0, 1.0) * clamp(width - inside + 0.5, 0.0, 1.0);
    gl_FragDepth = 0.5;
    colour = vec4(0.6 * capsule_rgb, 0.55 * share);
}
#else
void main()
{
    vec3 q = vec3(offset, 0.0);
    vec3 d = ray();
    float spine, miss;
    float t = meet(q, d, -1.0, spine, miss);
    vec2 outline = way_out(miss);
#ifdef OZ_SLICED
    /* Convex: the kept half is hit exactly where the ray leaves the capsule behind the plane. */
    float last_spine, last_miss;
    float start = dot(plane.xyz, capsule_centre.xyz + q) - plane.w;
    float rise = dot(plane.xyz, d);
    float left = start + meet(q, d, 1.0, last_spine, last_miss) * rise;
    vec2 end = way_out(-left);
    outline = dot(end, end) < dot(outline, outline) ? end : outline;
    miss = max(miss, -left);
    bool section = start + t * rise < 0.0;
    t = section ? -start / rise : t;
#endif
    if (miss >= 0.0) {
        discard;
    }
    vec3 p = q + t * d;
    vec3 rgb = shade((p - spine * capsule_axis.xyz) / capsule_centre.w, d);
#ifdef OZ_SLICED
    if (section) {
        rgb = shade_section(p);
    }
#endif
    gl_FragDepth = depth_of(capsule_centre.z + p.z);
    colour = vec4(rgb, outline_code(outline));
}
#endif
#endif
