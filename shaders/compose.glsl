/* The samples of each pixel become its colour. Row 0 of the result is the picture's top. */

#ifdef OZ_VERTEX
void main()
{
    gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0);
}
#endif

#ifdef OZ_FRAGMENT
uniform sampler2DMS colours;
uniform int sample_count;
uniform int rows;

out vec4 result;

void main()
{
    ivec2 place = ivec2(int(gl_FragCoord.x), rows - 1 - int(gl_FragCoord.y));
    vec3 rgb = vec3(0.0);
    for (int i = 0; i < sample_count; i++) {
        rgb += texelFetch(colours, place, i).rgb;
    }
    result = vec4(rgb / float(sample_count), 1.0);
}
#endif
