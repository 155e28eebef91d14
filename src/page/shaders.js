// The programs of the view in space. Lines are quads as wide as we like; a face that turns its back to the onlooker may
// be left out, so that one can look into a room; the verdicts of tested faces are hatched, each its own way.
'use strict';

const FACES_VERTEX = `#version 300 es
uniform mat4 matrix;
uniform vec3 onlooker;
in vec3 position, normal, colour;
in float cut; // 1: left out from behind
out vec3 shade;
out float seen;
void main() {
  gl_Position = matrix * vec4(position, 1);
  vec3 to = onlooker - position;
  seen = cut > 0.5 ? dot(normal, to) : 1.0;
  shade = colour * (0.45 + 0.55 * abs(dot(normal, normalize(normalize(to) + vec3(0.3, 0.5, 0.1)))));
}`;

const FACES_FRAGMENT = `#version 300 es
precision highp float;
in vec3 shade;
in float seen;
out vec4 colour;
void main() {
  if (seen < 0.0) discard;
  colour = vec4(shade, 1);
}`;

const VERDICTS_VERTEX = `#version 300 es
uniform mat4 matrix;
in vec3 position, colour;
in float hatch;
out vec3 shade;
flat out float kind;
void main() {
  gl_Position = matrix * vec4(position, 1);
  gl_Position.z -= 1e-4 * gl_Position.w;
  shade = colour;
  kind = hatch;
}`;

const VERDICTS_FRAGMENT = `#version 300 es
precision highp float;
in vec3 shade;
flat in float kind;
out vec4 colour;
void main() {
  vec2 p = gl_FragCoord.xy;
  float across = kind < 0.5 ? p.x : kind < 1.5 ? p.x + p.y : kind < 2.5 ? p.x - p.y :
                 kind < 3.5 ? p.y : p.x + 2.0 * p.y;
  colour = vec4(shade, kind > 4.5 ? 0.75 : fract(across / 9.0) < 0.45 ? 0.75 : 0.2);
}`;

const LINES_VERTEX = `#version 300 es
uniform mat4 matrix;
uniform vec2 size;
uniform float ratio, near;
in vec3 from, to, colour;
in float dash, width;
in vec2 corner;
out vec3 paint;
out float along, gap;
void main() {
  vec4 a = matrix * vec4(from, 1), b = matrix * vec4(to, 1);
  if (a.w < near) a = mix(b, a, (b.w - near) / (b.w - a.w));
  else if (b.w < near) b = mix(a, b, (a.w - near) / (a.w - b.w));
  vec2 pa = a.xy / a.w * size, pb = b.xy / b.w * size, d = pb - pa;
  float l = length(d);
  vec2 n = l > 0.0 ? vec2(-d.y, d.x) / l : vec2(0);
  vec4 p = corner.x < 0.5 ? a : b;
  gl_Position = p + vec4(n * corner.y * width * ratio / size * p.w, -2e-4 * p.w, 0);
  paint = colour;
  along = corner.x * l * 0.5 / ratio;
  gap = dash;
}`;

const LINES_FRAGMENT = `#version 300 es
precision highp float;
in vec3 paint;
in float along, gap;
out vec4 colour;
void main() {
  if (gap > 0.0 && fract(along / gap) > (gap > 12.0 ? 0.85 : 0.5)) discard;
  colour = vec4(paint, 1);
}`;

const SCREEN_VERTEX = `#version 300 es
uniform mat4 matrix;
in vec3 position;
in vec2 at;
out vec2 place;
void main() { gl_Position = matrix * vec4(position, 1); place = at; }`;

const SCREEN_FRAGMENT = `#version 300 es
precision highp float;
uniform sampler2D picture;
in vec2 place;
out vec4 colour;
void main() { colour = vec4(texture(picture, place).rgb, 0.65); }`;

function compileProgram(gl, vertex, fragment) {
    const program = gl.createProgram();
    for (const [type, source] of [
        [gl.VERTEX_SHADER, vertex],
        [gl.FRAGMENT_SHADER, fragment],
    ]) {
        const shader = gl.createShader(type);
        gl.shaderSource(shader, source);
        gl.compileShader(shader);
        if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
        gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    return program;
}

// A list of vertices, or of instances, on the graphics card. attributes: {name: how many numbers}, in the order of the
// data.
class VertexList {
    constructor(gl, program) {
        this.gl = gl;
        this.program = program;
        this.array = gl.createVertexArray();
        this.buffers = new Map();
        this.count = 0;
    }

    fill(data, attributes, perInstance = false) {
        const gl = this.gl;
        const key = Object.keys(attributes)[0];
        const stride = Object.values(attributes).reduce((sum, n) => sum + n, 0);
        if (!this.buffers.has(key)) this.buffers.set(key, gl.createBuffer());
        gl.bindVertexArray(this.array);
        gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers.get(key));
        gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(data), gl.DYNAMIC_DRAW);
        let offset = 0;
        for (const [name, numbers] of Object.entries(attributes)) {
            const at = gl.getAttribLocation(this.program, name);
            gl.enableVertexAttribArray(at);
            gl.vertexAttribPointer(at, numbers, gl.FLOAT, false, stride * 4, offset * 4);
            gl.vertexAttribDivisor(at, perInstance ? 1 : 0);
            offset += numbers;
        }
        return data.length / stride;
    }

    use(uniforms) {
        const gl = this.gl;
        gl.useProgram(this.program);
        for (const [name, value] of Object.entries(uniforms)) {
            const at = gl.getUniformLocation(this.program, name);
            if (name === 'matrix') gl.uniformMatrix4fv(at, false, value);
            else gl['uniform' + [value].flat().length + 'fv'](at, [value].flat());
        }
        gl.bindVertexArray(this.array);
    }
}
