#version 330 core
// The same surface as lipdb/render/scene.py `shade`, number for number; a test compares the two pictures.
struct DirectionalLight {
    vec3 color;
    float intensity;
    vec3 direction;
};
uniform DirectionalLight directional_lights[MAX_DIRECTIONAL_LIGHTS];
uniform int n_directional_lights;
uniform vec3 cam_pos;
in vec3 point;
in vec3 direction_out;
in vec4 surface;
in vec2 finish;
out vec4 frag_color;

const vec3 SKY = vec3(0.36, 0.37, 0.41);
const vec3 GROUND = vec3(0.19, 0.18, 0.19);
const vec3 SCATTER = vec3(0.34, 0.15, 0.08);

vec3 encode(vec3 linear) {
    vec3 rolled = clamp(linear * 1.10 / (1.0 + 0.18 * linear), 0.0, 1.0);
    return mix(rolled * 12.92, 1.055 * pow(rolled, vec3(1.0 / 2.4)) - 0.055, step(vec3(0.0031308), rolled));
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
    float facing = max(dot(n, v), 0.0);
    vec3 wrap = SCATTER * clamp(roughness * 2.0 - 0.5, 0.0, 1.0);
    vec3 light = mix(GROUND, SKY, (n.y + 1.0) / 2.0);
    vec3 shine = vec3(0.14 * specular * pow(1.0 - facing, 4.0));
    float exponent = 2.0 / (pow(roughness, 4.0) + 2e-3);
    float strength = (exponent + 8.0) / 25.13 * 1.7 * specular;
    for (int i = 0; i < n_directional_lights; i++) {
        vec3 l = -directional_lights[i].direction;
        vec3 colour = directional_lights[i].color * directional_lights[i].intensity;
        float incidence = dot(n, l);
        light += colour * max((incidence + wrap) / ((1.0 + wrap) * (1.0 + wrap)), 0.0);
        vec3 h = normalize(l + v);
        float fresnel = 0.04 + 0.96 * pow(max(1.0 - dot(h, l), 0.0), 5.0);
        shine += colour * fresnel * strength * pow(max(dot(n, h), 0.0), exponent) * clamp(incidence * 4.0, 0.0, 1.0);
    }
    frag_color = vec4(encode(surface.rgb * light + shine), 1.0);
}
