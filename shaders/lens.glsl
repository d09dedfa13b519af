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
