#version 330 core
// Position and normal pass through; the texture coordinates carry how rough and how specular, alpha 0 marks the wall behind.
layout(location = 0) in vec3 position;
layout(location = NORMAL_LOC) in vec3 normal;
layout(location = TEXCOORD_0_LOC) in vec2 texcoord_0;
layout(location = COLOR_0_LOC) in vec4 color_0;
layout(location = INST_M_LOC) in mat4 inst_m;
uniform mat4 V;
uniform mat4 P;
out vec3 point;
out vec3 direction_out;
out vec4 surface;
out vec2 finish;

void main() {
    gl_Position = P * (V * vec4(position, 1.0));
    point = position;
    direction_out = normal;
    surface = color_0;
    finish = texcoord_0;
}
