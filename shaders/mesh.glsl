/* Coloured triangles of the container: glass, floor and lines. */

#ifdef OZ_VERTEX
layout(location = 0) in vec3 place;
layout(location = 1) in vec4 rgba;

out vec4 vertex_rgba;
out float view_z;

void main()
{
    vertex_rgba = rgba;
    view_z = place.z;
    gl_Position = clip_of(place);
}
#endif

#ifdef OZ_FRAGMENT
in vec4 vertex_rgba;
in float view_z;
out vec4 colour;

void main()
{
    gl_FragDepth = depth_of(view_z);
    colour = vertex_rgba;
}
#endif
