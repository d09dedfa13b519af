/* Coloured triangles of the container: glass, floor and lines. */

#ifdef OZ_VERTEX
layout(location = 0) in vec3 place;
layout(location = 1) in vec4 rgba;
layout(location = 2) in vec2 across; /* pixels: from a line's middle, and half its width */

out vec4 vertex_rgba;
out float view_z;
out vec2 beside;

void main()
{
    vertex_rgba = rgba;
    view_z = place.z;
    beside = across;
    gl_Position = clip_of(place);
}
#endif

#ifdef OZ_FRAGMENT
in vec4 vertex_rgba;
in float view_z;
in vec2 beside;
out vec4 colour;

void main()
{
    gl_FragDepth = depth_of(view_z);
    float covered = clamp(beside.y + 0.5 - abs(beside.x), 0.0, 1.0);
    colour = vec4(vertex_rgba.rgb, vertex_rgba.a * covered);
}
#endif
