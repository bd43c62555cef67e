#version 330 core
// The same surface as lipdb/render/scene.py `shade`, number for number; a test compares the two pictures.
struct DirectionalLight {
    vec3 color;
    float intensity;
    vec3 direction;
};
uniform DirectionalLight directional_lights[MAX_DIRECTIONAL_LIGHTS];
uniform vec3 cam_pos;
in vec3 point;
in vec3 direction_out;
in vec4 surface;
in vec2 finish;
out vec4 frag_color;

const vec3 SKY = vec3(0.36, 0.37, 0.41);
const vec3 GROUND = vec3(0.19, 0.18, 0.19);
const vec3 SCATTER = vec3(0.34, 0.15, 0.08);

// Square roots and one exponential instead of powers: drawn in software, powers would be most of a picture's time.
vec3 encode(vec3 linear) {
    vec3 a = sqrt(clamp(linear * 1.10 / (1.0 + 0.18 * linear), 0.0, 1.0));
    vec3 b = sqrt(a);
    return 0.662002687 * a + 0.684122060 * b - 0.323583601 * sqrt(b) - 0.0225411470 * a * a;
}

void main() {
    if (surface.a < 0.5) {
        frag_color = vec4(encode(surface.rgb), 1.0);
        return;
    }
    float roughness = finish.x;
    float specular = finish.y;
    vec3 n = normalize(direction_out);
    vec3 v = normalize(cam_pos - point);
    vec3 wrap = SCATTER * clamp(roughness * 2.0 - 0.5, 0.0, 1.0);
    vec3 even = 1.0 / ((1.0 + wrap) * (1.0 + wrap));
    vec3 light = mix(GROUND, SKY, (n.y + 1.0) / 2.0);
    float edge = 1.0 - max(dot(n, v), 0.0);
    edge *= edge;
    vec3 shine = vec3(0.14 * specular * edge * edge);
    float rough2 = roughness * roughness;
    float exponent = 2.0 / (rough2 * rough2 + 2e-3);
    float strength = (exponent + 8.0) / 25.13 * 1.7 * specular;
    // A fixed count (that of LIGHTS) lets the compiler unroll the loop: twice as fast.
    for (int i = 0; i < 3; i++) {
        vec3 l = -directional_lights[i].direction;
        vec3 colour = directional_lights[i].color;
        float incidence = dot(n, l);
        light += colour * max((incidence + wrap) * even, 0.0);
        vec3 h = normalize(l + v);
        float grazing = 1.0 - dot(h, l);
        float grazing2 = grazing * grazing;
        float fresnel = 0.04 + 0.96 * grazing2 * grazing2 * grazing;
        float lobe = exp2(exponent * 1.442695 * (max(dot(n, h), 0.0) - 1.0));
        shine += colour * (fresnel * strength * lobe * clamp(incidence * 4.0, 0.0, 1.0));
    }
    frag_color = vec4(encode(surface.rgb * light + shine), 1.0);
}
