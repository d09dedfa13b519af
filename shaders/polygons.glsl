/* Triangles of flat grains and their walls, with a line along the inside of their outer edges. */

#ifdef OZ_VERTEX
layout(location = 0) in vec2 place;
layout(location = 1) in vec4 rgba;
layout(location = 2) in vec3 line_rgb;
layout(location = 3) in vec3 inside; /* pixels from each edge that is to be seen; far for others */

out vec4 fill;
out vec3 ink;
out vec3 edges;

void main()
{
    fill = rgba;
    ink = line_rgb;
    edges = inside;
    gl_Position = clip_of(vec3(place, 0.0));
}
#endif

#ifdef OZ_FRAGMENT
uniform float line; /* pixels: the outline's width, 0 for none */

in vec4 fill;
in vec3 ink;
in vec3 edges;
out vec4 colour;

void main()
{
    float within = min(edges.x, min(edges.y, edges.z)) - line;
    float share = line > 0.0 ? clamp(within + 0.5, 0.0, 1.0) : 1.0;
    colour = vec4(mix(ink, fill.rgb, share), fill.a);
}
#endif
