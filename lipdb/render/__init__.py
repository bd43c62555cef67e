"""Pictures of a character: with OpenGL through pyrender where there is any, with numpy alone where there is none."""
