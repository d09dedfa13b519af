/* The camera that every shader shares: a near-orthographic perspective on view coordinates (x right,
 * y up, z towards the eye, origin at the middle of what is framed). */

uniform vec4 lens; /* clip units per view unit across and up; the eye's distance; half the depth range */

/* Depth is linear in z, so that differences of depth are lengths. 0 is nearest. */
float depth_of(float z)
{
    return clamp(0.5 - 0.5 * z / lens.w, 0.0, 1.0);
}

/* Clip position; its z is left at the middle, since fragments write their own depth. */
vec4 clip_of(vec3 view)
{
    return vec4(view.xy * lens.xy * lens.z, 0.0, lens.z - view.z);
}

/* How a pixel of a grain tells those beside it where its outline runs: the way from its middle to the
 * outline, along a row or a column, if it is shorter than a pixel. 0 is kept for what is no grain's, 1
 * for a pixel without such an outline. */
float outline_code(vec2 way)
{
    float code = way.x != 0.0 ? 64.0 + 62.0 * way.x : 192.0 + 62.0 * way.y;
    return max(abs(way.x), abs(way.y)) < 1.0 ? code / 255.0 : 1.0;
}
