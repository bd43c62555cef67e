#version 330 core
// Vertices come lit (lipdb/render/scene.py `shade`): what is left is where they stand.
layout(location = 0) in vec3 position;
layout(location = COLOR_0_LOC) in vec4 color_0;
layout(location = INST_M_LOC) in mat4 inst_m;
uniform mat4 V;
uniform mat4 P;
out vec3 light;

void main() {
    gl_Position = P * (V * vec4(position, 1.0));
    light = color_0.rgb;
}
