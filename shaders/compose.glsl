/* The samples of each pixel become its colour, darkened where nearer things stand around it (Luft,
 * Colditz & Deussen 2006: a depth buffer against its own surroundings) and faded with depth. Row 0 of
 * the result is the picture's top. */

#ifdef OZ_VERTEX
void main()
{
    gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0);
}
#endif

#ifdef OZ_FRAGMENT
const int PAIRS_MOST = 64;

uniform sampler2DMS colours;
uniform sampler2DMS depths;
uniform int sample_count;
uniform int rows;
uniform int pairs;
uniform vec2 taps[PAIRS_MOST]; /* pixels; the other of a pair lies opposite */
uniform vec4 mood;        /* 1/depth at which a pair darkens fully; darkening; fade */
uniform vec4 retreat;     /* by depth, by row, constant: how far behind the middle, 0 to 1 */
uniform vec4 background;

out vec4 result;

float depth_at(ivec2 place)
{
    return texelFetch(depths, clamp(place, ivec2(0), textureSize(depths) - 1), 0).r;
}

/* How much stands in front of this depth nearby, 0 to 1. Opposite neighbours are taken together, so that
 * neither a slanting nor a bulging surface darkens itself; a pair that reaches past everything into the
 * background (depth 1) says nothing. */
float crowding(ivec2 place, float depth)
{
    float sum = 0.0;
    int count = depth > 0.0 ? pairs : 0; /* a loop is left early where an if is not */
    for (int i = 0; i < count; i++) {
        ivec2 tap = ivec2(taps[i]);
        float one = depth_at(place + tap), other = depth_at(place - tap);
        float nearer = max(one, other) < 1.0 ? 2.0 * depth - one - other : 0.0;
        sum += clamp(nearer * mood.x, 0.0, 1.0);
    }
    return sum / float(pairs);
}

void main()
{
    ivec2 place = ivec2(int(gl_FragCoord.x), rows - 1 - int(gl_FragCoord.y));
    vec3 rgb = vec3(0.0);
    float depth = 0.0, filled = 0.0; /* of the samples that hold anything */
    for (int i = 0; i < sample_count; i++) {
        float own = texelFetch(depths, place, i).r;
        rgb += texelFetch(colours, place, i).rgb;
        depth += own < 1.0 ? own : 0.0;
        filled += own < 1.0 ? 1.0 : 0.0;
    }
    rgb /= float(sample_count);
    depth /= max(filled, 1.0);
    filled /= float(sample_count);
    float behind = retreat.x * depth + retreat.y * float(place.y) + retreat.z;
    rgb *= 1.0 - mood.y * filled * crowding(place, depth);
    rgb = mix(rgb, background.rgb, mood.z * filled * clamp(behind, 0.0, 1.0));
    result = vec4(rgb, 1.0);
}
#endif
