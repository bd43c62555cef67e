#version 330 core
// Linear light to sRGB, as lipdb/render/scene.py `encode` does it: square roots, because in software powers cost most of a picture.
in vec3 light;
out vec4 frag_color;

void main() {
    vec3 a = sqrt(clamp(light * 1.10 / (1.0 + 0.18 * light), 0.0, 1.0));
    vec3 b = sqrt(a);
    frag_color = vec4(0.662002687 * a + 0.684122060 * b - 0.323583601 * sqrt(b) - 0.0225411470 * a * a, 1.0);
}
