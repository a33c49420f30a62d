// Specimens by WebGL 2. Discs, forces and cracks are instances whose vertices fetch the displacements of two frames from a texture
// and blend them, so that moving the slider costs the script a few uniforms and draw calls per specimen, whatever the number of discs.
import { Scene, lastUpTo } from "./data";
import { Colors, Moment, Painter, Pictured, ViewState, between, ramps, tones } from "./painter";

const rows = 256; // width of the displacement texture

const common = `#version 300 es
precision highp float;
precision highp int;
precision highp isampler2DArray;
uniform isampler2DArray moves;
uniform int layerA, layerB;
uniform float blend, quantum, magnify;
uniform vec2 middle, scale, size;
vec2 moved(int i) {
  ivec2 at = ivec2(i % ${rows}, i / ${rows});
  vec2 a = vec2(texelFetch(moves, ivec3(at, layerA), 0).xy);
  vec2 b = vec2(texelFetch(moves, ivec3(at, layerB), 0).xy);
  return mix(a, b, blend) * quantum;
}
vec4 place(vec2 p) { return vec4((p - middle) * scale, 0.0, 1.0); }
`;

const discVertex = `${common}
layout(location = 0) in vec2 corner;
layout(location = 1) in vec3 disc;
layout(location = 2) in float tone;
uniform int field;
uniform float range, pixel;
uniform vec3 tones[3];
uniform vec3 ramp[5];
uniform float dim;
out vec2 at;
out float edge;
flat out vec3 color;
vec3 ramped(float t) {
  t = clamp(t, 0.0, 1.0) * 4.0;
  int i = min(int(t), 3);
  return mix(ramp[i], ramp[i + 1], t - float(i));
}
void main() {
  vec2 u = moved(gl_InstanceID);
  at = corner * (1.0 + pixel / disc.z);
  edge = pixel / disc.z;
  color = tones[int(tone)];
  if (field == 1) color = ramped(length(u) / range);
  if (field == 2) color = ramped(0.5 + 0.5 * u.x / range);
  if (field == 3) color = ramped(0.5 + 0.5 * u.y / range);
  color = mix(color, tones[0], dim);
  gl_Position = place(disc.xy + magnify * u + at * disc.z);
}`;

const discFragment = `#version 300 es
precision highp float;
in vec2 at;
in float edge;
flat in vec3 color;
out vec4 result;
void main() {
  float d = length(at);
  float a = 1.0 - smoothstep(1.0 - edge, 1.0 + edge, d);
  if (a <= 0.0) discard;
  float rim = smoothstep(1.0 - 3.5 * max(edge, 0.06), 1.0, d) * (1.0 - smoothstep(0.25, 0.7, edge));
  result = vec4(color * (1.0 - 0.28 * rim), a);
}`;

const lineFragment = `#version 300 es
precision highp float;
flat in vec4 color;
out vec4 result;
void main() { result = color; }`;

const forceVertex = `${common}
layout(location = 0) in vec2 corner;
layout(location = 1) in uvec2 link;
layout(location = 2) in float force;
uniform sampler2D discs;
uniform float width, pixel;
uniform vec3 push, pull;
flat out vec4 color;
vec2 centre(uint i) {
  int k = int(i);
  return texelFetch(discs, ivec2(k % ${rows}, k / ${rows}), 0).xy + magnify * moved(k);
}
void main() {
  float part = abs(force) / 127.0;
  float load = part * part;
  color = vec4(force > 0.0 ? push : pull, 0.9);
  if (load < 0.04) { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); return; }
  vec2 a = centre(link.x), b = centre(link.y), d = b - a;
  float l = max(length(d), 1e-9);
  vec2 n = vec2(-d.y, d.x) / l;
  gl_Position = place(a + 0.5 * (corner.x + 1.0) * d + corner.y * n * max(0.5 * width * load, 0.35 * pixel));
}`;

const crackVertex = `${common}
layout(location = 0) in vec2 corner;
layout(location = 1) in uvec2 pair;
layout(location = 2) in vec3 shape;
layout(location = 3) in float kind;
uniform sampler2D discs;
uniform float pixel;
uniform vec3 kinds[4];
flat out vec4 color;
void main() {
  int i = int(pair.x), j = int(pair.y);
  vec4 a = texelFetch(discs, ivec2(i % ${rows}, i / ${rows}), 0);
  vec4 b = texelFetch(discs, ivec2(j % ${rows}, j / ${rows}), 0);
  vec2 p = a.xy + magnify * moved(i), q = b.xy + magnify * moved(j);
  vec2 c = mix(p, q, a.z / (a.z + b.z));
  vec2 along = vec2(-shape.y, shape.x);
  float half_length = max(0.62 * shape.z, 1.4 * pixel), half_width = max(0.13 * shape.z, 0.75 * pixel);
  color = vec4(kinds[int(kind)], 1.0);
  gl_Position = place(c + corner.x * half_length * along + corner.y * half_width * shape.xy);
}`;

function shader(gl: WebGL2RenderingContext, type: number, source: string): WebGLShader {
  const s = gl.createShader(type)!;
  gl.shaderSource(s, source);
  gl.compileShader(s);
  return s;
}

class Program {
  readonly handle: WebGLProgram;
  private places = new Map<string, WebGLUniformLocation | null>();
  constructor(
    private gl: WebGL2RenderingContext,
    vertex: string,
    fragment: string,
  ) {
    this.handle = gl.createProgram()!;
    gl.attachShader(this.handle, shader(gl, gl.VERTEX_SHADER, vertex));
    gl.attachShader(this.handle, shader(gl, gl.FRAGMENT_SHADER, fragment));
    gl.linkProgram(this.handle);
    if (!gl.getProgramParameter(this.handle, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(this.handle) ?? "");
  }
  at(name: string) {
    if (!this.places.has(name)) this.places.set(name, this.gl.getUniformLocation(this.handle, name));
    return this.places.get(name)!;
  }
}

/** Draws `n` instances of one of Loaded's arrays; `set`: what only this program needs. */
type Layer = (program: Program, array: number, n: number, set: () => void) => void;

/** What the graphics processor holds of one specimen. */
interface Loaded {
  what: Pictured;
  scene: Scene;
  textures: WebGLTexture[]; // displacements; discs
  buffers: WebGLBuffer[];
  arrays: WebGLVertexArrayObject[]; // discs, forces, cracks
  forceBuffer: WebGLBuffer;
  forceScale: number;
}

function hex(color: string): [number, number, number] {
  const v = parseInt(color.slice(1), 16);
  return [((v >> 16) & 255) / 255, ((v >> 8) & 255) / 255, (v & 255) / 255];
}
const list = (colors: string[]) => colors.flatMap(hex);
const [ramp, diverging] = [list(ramps.magnitude), list(ramps.signed)];

export class GlPainter implements Painter {
  private loaded = new Map<number, Loaded>();
  private disc: Program;
  private force: Program;
  private crack: Program;
  private quad: WebGLBuffer;
  private inks = { tones: [] as number[], push: [] as number[], pull: [] as number[], kinds: [] as number[] };

  constructor(private gl: WebGL2RenderingContext) {
    this.disc = new Program(gl, discVertex, discFragment);
    this.force = new Program(gl, forceVertex, lineFragment);
    this.crack = new Program(gl, crackVertex, lineFragment);
    this.quad = this.buffer(new Float32Array([-1, -1, 1, -1, -1, 1, 1, 1]));
    gl.enable(gl.BLEND);
    gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  }

  set colors(c: Colors) {
    this.inks = { tones: list(c.tones), push: hex(c.push), pull: hex(c.pull), kinds: list(c.kinds) };
  }

  clear() {
    const gl = this.gl;
    gl.viewport(0, 0, gl.canvas.width, gl.canvas.height);
    gl.disable(gl.SCISSOR_TEST);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.enable(gl.SCISSOR_TEST);
  }

  end() {
    this.gl.getExtension("WEBGL_lose_context")?.loseContext();
  }

  paint(number: number, state: ViewState, now: Moment) {
    const l = this.loaded.get(number);
    if (!l) return;
    const gl = this.gl;
    const { strain, cell, metres, dpr, range } = now;
    const at = between(l.scene, strain);
    const x = Math.round(cell.left * dpr);
    const w = Math.round(cell.width * dpr);
    const h = Math.round(cell.height * dpr);
    const y = gl.canvas.height - Math.round(cell.top * dpr) - h;
    gl.viewport(x, y, w, h);
    gl.scissor(x, y, w, h);
    const use = (p: Program) => {
      gl.useProgram(p.handle);
      gl.uniform1i(p.at("moves"), 0);
      gl.uniform1i(p.at("layerA"), at.before);
      gl.uniform1i(p.at("layerB"), at.after);
      gl.uniform1f(p.at("blend"), at.blend);
      gl.uniform1f(p.at("quantum"), l.scene.quantum);
      gl.uniform1f(p.at("magnify"), state.magnify);
      gl.uniform1f(p.at("pixel"), metres / dpr);
      gl.uniform2f(
        p.at("middle"),
        l.scene.width * (0.5 + state.x),
        l.scene.height * 0.5 + l.scene.width * state.y,
      );
      gl.uniform2f(p.at("scale"), 2 / (metres * cell.width), 2 / (metres * cell.height));
    };
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D_ARRAY, l.textures[0]);
    gl.activeTexture(gl.TEXTURE1);
    gl.bindTexture(gl.TEXTURE_2D, l.textures[1]);
    const layer: Layer = (p, array, n, set) => {
      use(p);
      gl.uniform1i(p.at("discs"), 1);
      gl.bindVertexArray(l.arrays[array]);
      set();
      gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, n);
    };
    layer(this.disc, 0, l.scene.discs.length / 3, () => this.setDiscs(state, range));
    if (state.forces) this.paintForces(l, strain, layer);
    if (state.cracks) layer(this.crack, 2, lastUpTo(l.what.cracks.strain, strain) + 1, () => gl.uniform3fv(this.crack.at("kinds"), this.inks.kinds));
  }

  private setDiscs(state: ViewState, range: number) {
    const gl = this.gl;
    gl.uniform1i(this.disc.at("field"), ["bedding", "magnitude", "horizontal", "vertical"].indexOf(state.field));
    gl.uniform1f(this.disc.at("range"), range);
    gl.uniform3fv(this.disc.at("tones"), this.inks.tones);
    gl.uniform3fv(this.disc.at("ramp"), state.field === "magnitude" ? ramp : diverging);
    gl.uniform1f(this.disc.at("dim"), state.forces ? 0.65 : 0);
  }

  private paintForces(l: Loaded, strain: number, layer: Layer) {
    const gl = this.gl;
    if (l.scene.forceStrains.length === 0) return;
    const field = Math.max(0, lastUpTo(l.scene.forceStrains, strain));
    const n = l.scene.links.length / 2;
    layer(this.force, 1, n, () => {
      gl.uniform1f(this.force.at("width"), 0.0011 * Math.min(1, l.scene.forceMax[field] / l.forceScale));
      gl.uniform3fv(this.force.at("push"), this.inks.push);
      gl.uniform3fv(this.force.at("pull"), this.inks.pull);
      gl.bindBuffer(gl.ARRAY_BUFFER, l.forceBuffer);
      gl.vertexAttribPointer(2, 1, gl.BYTE, false, 0, field * n);
    });
  }

  private buffer(data: ArrayBufferView): WebGLBuffer {
    const b = this.gl.createBuffer()!;
    this.gl.bindBuffer(this.gl.ARRAY_BUFFER, b);
    this.gl.bufferData(this.gl.ARRAY_BUFFER, data as BufferSource, this.gl.STATIC_DRAW);
    return b;
  }

  /** A vertex array with the quad at 0 and per-instance attributes from 1 on. */
  private instances(...parts: { data: ArrayBufferView; size: number; type: number; integer?: boolean }[]) {
    const gl = this.gl;
    const vao = gl.createVertexArray()!;
    gl.bindVertexArray(vao);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.quad);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 2, gl.FLOAT, false, 0, 0);
    const buffers = parts.map((p, i) => {
      const b = this.buffer(p.data);
      gl.enableVertexAttribArray(i + 1);
      if (p.integer) gl.vertexAttribIPointer(i + 1, p.size, p.type, 0, 0);
      else gl.vertexAttribPointer(i + 1, p.size, p.type, false, 0, 0);
      gl.vertexAttribDivisor(i + 1, 1);
      return b;
    });
    gl.bindVertexArray(null);
    return { vao, buffers };
  }

  private texture(target: number): WebGLTexture {
    const t = this.gl.createTexture()!;
    this.gl.bindTexture(target, t);
    for (const name of [this.gl.TEXTURE_MIN_FILTER, this.gl.TEXTURE_MAG_FILTER])
      this.gl.texParameteri(target, name, this.gl.NEAREST);
    return t;
  }

  private drop(number: number) {
    const l = this.loaded.get(number);
    if (!l) return;
    l.textures.forEach((t) => this.gl.deleteTexture(t));
    l.buffers.forEach((b) => this.gl.deleteBuffer(b));
    l.arrays.forEach((a) => this.gl.deleteVertexArray(a));
    this.loaded.delete(number);
  }

  take(number: number, what: Pictured, scene: Scene) {
    const gl = this.gl;
    this.drop(number);
    const n = scene.discs.length / 3;
    const lines = Math.ceil(n / rows);
    gl.activeTexture(gl.TEXTURE0);
    const moves = this.texture(gl.TEXTURE_2D_ARRAY);
    const limit = gl.getParameter(gl.MAX_ARRAY_TEXTURE_LAYERS) as number;
    while (scene.frames.length > limit) {
      scene.frames = scene.frames.filter((_, i) => i % 2 === 0);
      scene.strains = scene.strains.filter((_, i) => i % 2 === 0);
    }
    gl.texStorage3D(gl.TEXTURE_2D_ARRAY, 1, gl.RG16I, rows, lines, scene.frames.length);
    const plane = new Int16Array(2 * rows * lines);
    scene.frames.forEach((frame, k) => {
      plane.set(frame);
      gl.texSubImage3D(gl.TEXTURE_2D_ARRAY, 0, 0, 0, k, rows, lines, 1, gl.RG_INTEGER, gl.SHORT, plane);
    });
    const table = this.texture(gl.TEXTURE_2D);
    const cells = new Float32Array(4 * rows * lines);
    for (let i = 0; i < n; ++i) cells.set(scene.discs.subarray(3 * i, 3 * i + 3), 4 * i);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, rows, lines, 0, gl.RGBA, gl.FLOAT, cells);
    const c = what.cracks;
    const pairs = new Uint32Array(2 * c.a.length);
    const shapes = new Float32Array(3 * c.a.length);
    for (let i = 0; i < c.a.length; ++i) {
      pairs.set([c.a[i], c.b[i]], 2 * i);
      shapes.set([c.normal_x[i], c.normal_y[i], c.size[i]], 3 * i);
    }
    const forces = this.instances(
      { data: scene.links, size: 2, type: gl.UNSIGNED_INT, integer: true },
      { data: scene.forces, size: 1, type: gl.BYTE },
    );
    const discs = this.instances({ data: scene.discs, size: 3, type: gl.FLOAT }, { data: tones(scene, what), size: 1, type: gl.UNSIGNED_BYTE });
    const cracks = this.instances({ data: pairs, size: 2, type: gl.UNSIGNED_INT, integer: true }, { data: shapes, size: 3, type: gl.FLOAT }, { data: c.kind, size: 1, type: gl.UNSIGNED_BYTE });
    const arrays = [discs, forces, cracks];
    this.loaded.set(number, {
      what,
      scene,
      textures: [moves, table],
      buffers: arrays.flatMap((x) => x.buffers),
      arrays: arrays.map((x) => x.vao),
      forceBuffer: forces.buffers[1],
      forceScale: Math.max(1e-30, ...scene.forceMax),
    });
  }
}
