// The specimens, drawn by WebGL: one canvas, one context, a cell per specimen. Discs, forces and cracks are
// instances whose vertices fetch the displacements of two frames from a texture and blend them, so that moving
// the slider costs the script a few uniforms and draw calls per specimen, whatever the number of discs.
import { Scene, Test, lastUpTo, readScene } from "./data";

export type Field = "bedding" | "magnitude" | "horizontal" | "vertical";

export interface ViewState {
  field: Field;
  forces: boolean;
  cracks: boolean;
  magnify: number; // of displacements
  zoom: number;
  x: number; // of the view's centre, in widths of the specimen from its centre
  y: number;
  only: number | null; // the one specimen shown, or all
}

/** Colour scales of displacements from 0, and of signed ones. */
export const ramps = {
  magnitude: ["#30123b", "#3e7ef7", "#1bcfb0", "#c7ee3d", "#f3a32e"],
  signed: ["#2166ac", "#92c5de", "#f2f2f0", "#f4a582", "#b2182b"],
};

const rows = 256; // width of the displacement texture
export const headHeight = 24; // above a specimen: its name [CSS pixels]
const footHeight = 42; // below: stress and cracks, two lines

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

/** Buffers of one specimen. */
interface Loaded {
  test: Test;
  scene: Scene;
  moves: WebGLTexture;
  table: WebGLTexture;
  discs: WebGLVertexArrayObject;
  forces: WebGLVertexArrayObject;
  forceBuffer: WebGLBuffer;
  cracks: WebGLVertexArrayObject;
  range: [number, number, number]; // 98th percentile of |u|, |u_x|, |u_y| at the end [m]
  forceScale: number;
}

/** Which tone a disc has: 0 and 1 alternate between bedding planes, 2 carries a joint. */
function tones(scene: Scene, test: Test): Uint8Array {
  const n = scene.discs.length / 3;
  const out = new Uint8Array(n);
  const set = test.bedding[0];
  if (set) {
    const angle = (set.theta * Math.PI) / 180;
    const [nx, ny] = [-Math.sin(angle), Math.cos(angle)];
    for (let i = 0; i < n; ++i) {
      const along =
        nx * (scene.discs[3 * i] - scene.width / 2) + ny * (scene.discs[3 * i + 1] - scene.height / 2) - set.offset;
      out[i] = Math.abs(Math.floor(along / set.spacing)) % 2;
    }
  }
  scene.kinds.forEach((kind, i) => {
    if (kind === 2) out[scene.links[2 * i]] = out[scene.links[2 * i + 1]] = 2;
  });
  return out;
}

function percentile(values: Float32Array, part: number): number {
  values.sort();
  return values[Math.floor(part * (values.length - 1))] || 0;
}

function ranges(scene: Scene): [number, number, number] {
  const last = scene.frames[scene.frames.length - 1];
  const n = last.length / 2;
  const all = [0, 1, 2].map(() => new Float32Array(n));
  for (let i = 0; i < n; ++i) {
    const [x, y] = [last[2 * i] * scene.quantum, last[2 * i + 1] * scene.quantum];
    all[0][i] = Math.hypot(x, y);
    all[1][i] = Math.abs(x);
    all[2][i] = Math.abs(y);
  }
  return [percentile(all[0], 0.98), percentile(all[1], 0.98), percentile(all[2], 0.98)];
}

function hex(color: string): [number, number, number] {
  const v = parseInt(color.trim().slice(1), 16);
  return [((v >> 16) & 255) / 255, ((v >> 8) & 255) / 255, (v & 255) / 255];
}

export interface Cell {
  test: number;
  left: number;
  top: number;
  width: number;
  height: number; // CSS pixels within the canvas
}

export class Viewer {
  readonly state: ViewState = { field: "bedding", forces: false, cracks: true, magnify: 1, zoom: 1, x: 0, y: 0, only: null };
  cells: Cell[] = [];
  height = 0; // of the canvas [CSS pixels]
  scriptTime: number[] = []; // milliseconds of the last frames
  private loaded: (Loaded | null)[];
  private unreadable = new Set<number>();
  private gl: WebGL2RenderingContext;
  private disc: Program;
  private force: Program;
  private crack: Program;
  private quad: WebGLBuffer;
  private colors!: { tones: number[]; push: number[]; pull: number[]; kinds: number[]; ramp: number[]; diverging: number[] };
  private strains: number[];
  private queued = false;

  constructor(
    readonly canvas: HTMLCanvasElement,
    readonly tests: Test[],
    private sign: number, // of recorded strains
    private onLayout: () => void,
    private besides: () => number, // height of what is to be seen together with one specimen [CSS pixels]
  ) {
    const gl = canvas.getContext("webgl2", { antialias: true, alpha: true, preserveDrawingBuffer: true });
    if (!gl) throw new Error("this browser has no WebGL 2");
    this.gl = gl;
    this.disc = new Program(gl, discVertex, discFragment);
    this.force = new Program(gl, forceVertex, lineFragment);
    this.crack = new Program(gl, crackVertex, lineFragment);
    this.quad = this.buffer(new Float32Array([-1, -1, 1, -1, -1, 1, 1, 1]));
    this.loaded = tests.map(() => null);
    this.strains = tests.map((t) => t.end);
    this.readColors();
    gl.enable(gl.BLEND);
    gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  }

  async load(): Promise<void> {
    for (let i = 0; i < this.tests.length; ++i) {
      const id = this.tests[i].scene;
      if (!id) continue;
      try {
        this.loaded[i] = this.upload(this.tests[i], await readScene(id, this.sign));
      } catch (error) {
        this.unreadable.add(i); // the numbers of the specimen stand
      }
      this.layout();
      await new Promise((done) => setTimeout(done));
    }
  }

  /** Why a specimen is not seen; "": it is. */
  absent(test: number): string {
    if (this.loaded[test]) return "";
    return !this.tests[test].scene ? "no picture stored" : this.unreadable.has(test) ? "cannot be read" : "loading …";
  }

  /** Axial strain at which each specimen is shown. */
  show(strains: number[]) {
    this.strains = strains;
    this.draw();
  }

  readColors() {
    const style = getComputedStyle(document.documentElement);
    const get = (name: string) => hex(style.getPropertyValue(name));
    const list = (...names: string[]) => names.flatMap(get);
    this.colors = {
      tones: list("--grain-0", "--grain-1", "--grain-2"),
      push: get("--push"),
      pull: get("--pull"),
      kinds: list("--crack-0", "--crack-1", "--crack-2", "--crack-3"),
      ramp: ramps.magnitude.flatMap(hex),
      diverging: ramps.signed.flatMap(hex),
    };
  }

  /** Divides the canvas into cells: as many columns as keep a specimen readable. */
  layout() {
    const shown = this.state.only === null ? this.tests.map((_, i) => i) : [this.state.only];
    const width = this.canvas.clientWidth;
    const first = this.loaded.find((l) => l !== null);
    const aspect = first ? first.scene.height / first.scene.width : 2;
    const least = width < 520 ? 80 : 130;
    const columns = Math.max(1, Math.min(shown.length, Math.floor(width / least)));
    const lines = Math.ceil(shown.length / columns);
    const even = Math.ceil(shown.length / lines);
    const cellWidth = width / even;
    const limit = shown.length === 1 ? Math.max(200, window.innerHeight - headHeight - footHeight - this.besides()) : 620;
    const cellHeight = Math.min(limit, cellWidth * aspect);
    this.cells = shown.map((test, k) => ({
      test,
      left: (k % even) * cellWidth,
      top: Math.floor(k / even) * (cellHeight + headHeight + footHeight) + headHeight,
      width: cellWidth,
      height: cellHeight,
    }));
    const height = lines * (cellHeight + headHeight + footHeight);
    this.height = height;
    this.canvas.style.aspectRatio = `${width} / ${height}`; // kept on paper, which is of another width
    const dpr = Math.min(2, window.devicePixelRatio || 1);
    const [w, h] = [Math.round(width * dpr), Math.round(height * dpr)];
    if (this.canvas.width !== w) this.canvas.width = w;
    if (this.canvas.height !== h) this.canvas.height = h;
    this.onLayout();
    this.draw();
  }

  /** Draws with the next frame of the browser. */
  draw() {
    if (this.queued) return;
    this.queued = true;
    requestAnimationFrame(() => {
      this.queued = false;
      this.drawNow();
    });
  }

  /** The largest value on the colour scale [m], common to all specimens. */
  range(): number {
    const k = { bedding: 0, magnitude: 0, horizontal: 1, vertical: 2 }[this.state.field];
    return Math.max(1e-9, ...this.loaded.map((l) => (l ? l.range[k] : 0)));
  }

  /** Metres per CSS pixel in a cell. */
  metresPerPixel(cell: Cell): number {
    const l = this.loaded[cell.test];
    if (!l) return 1;
    return Math.max(l.scene.width / cell.width, l.scene.height / cell.height) * (1.08 / this.state.zoom);
  }

  /** Moves the view along with a pointer [CSS pixels]. */
  pan(dx: number, dy: number) {
    const cell = this.cells.find((c) => this.loaded[c.test] !== null);
    if (!cell) return;
    const part = this.metresPerPixel(cell) / this.loaded[cell.test]!.scene.width;
    this.state.x -= dx * part;
    this.state.y += dy * part;
    this.draw();
  }

  drawNow() {
    const start = performance.now();
    const gl = this.gl;
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.disable(gl.SCISSOR_TEST);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.enable(gl.SCISSOR_TEST);
    const dpr = this.canvas.width / Math.max(1, this.canvas.clientWidth);
    for (const cell of this.cells) {
      const l = this.loaded[cell.test];
      if (!l) continue;
      const x = Math.round(cell.left * dpr);
      const w = Math.round(cell.width * dpr);
      const h = Math.round(cell.height * dpr);
      const y = this.canvas.height - Math.round(cell.top * dpr) - h;
      gl.viewport(x, y, w, h);
      gl.scissor(x, y, w, h);
      this.drawCell(l, cell, dpr);
    }
    this.scriptTime.push(performance.now() - start);
    if (this.scriptTime.length > 120) this.scriptTime.shift();
  }

  private drawCell(l: Loaded, cell: Cell, dpr: number) {
    const gl = this.gl;
    const strain = this.strains[cell.test];
    const metres = this.metresPerPixel(cell);
    const before = Math.max(0, lastUpTo(l.scene.strains, strain));
    const after = Math.min(before + 1, l.scene.strains.length - 1);
    const span = l.scene.strains[after] - l.scene.strains[before];
    const use = (p: Program) => {
      gl.useProgram(p.handle);
      gl.uniform1i(p.at("moves"), 0);
      gl.uniform1i(p.at("layerA"), before);
      gl.uniform1i(p.at("layerB"), after);
      gl.uniform1f(p.at("blend"), span > 0 ? Math.min(1, Math.max(0, (strain - l.scene.strains[before]) / span)) : 0);
      gl.uniform1f(p.at("quantum"), l.scene.quantum);
      gl.uniform1f(p.at("magnify"), this.state.magnify);
      gl.uniform1f(p.at("pixel"), metres / dpr);
      gl.uniform2f(
        p.at("middle"),
        l.scene.width * (0.5 + this.state.x),
        l.scene.height * 0.5 + l.scene.width * this.state.y,
      );
      gl.uniform2f(p.at("scale"), 2 / (metres * cell.width), 2 / (metres * cell.height));
    };
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D_ARRAY, l.moves);
    gl.activeTexture(gl.TEXTURE1);
    gl.bindTexture(gl.TEXTURE_2D, l.table);
    use(this.disc);
    gl.uniform1i(this.disc.at("field"), ["bedding", "magnitude", "horizontal", "vertical"].indexOf(this.state.field));
    gl.uniform1f(this.disc.at("range"), this.range());
    gl.uniform3fv(this.disc.at("tones"), this.colors.tones);
    gl.uniform3fv(this.disc.at("ramp"), this.state.field === "magnitude" ? this.colors.ramp : this.colors.diverging);
    gl.uniform1f(this.disc.at("dim"), this.state.forces ? 0.65 : 0);
    gl.bindVertexArray(l.discs);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, l.scene.discs.length / 3);
    if (this.state.forces) this.drawForces(l, strain, use);
    if (!this.state.cracks) return;
    use(this.crack);
    gl.uniform1i(this.crack.at("discs"), 1);
    gl.uniform3fv(this.crack.at("kinds"), this.colors.kinds);
    gl.bindVertexArray(l.cracks);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, lastUpTo(l.test.cracks.strain, strain) + 1);
  }

  private drawForces(l: Loaded, strain: number, use: (p: Program) => void) {
    const gl = this.gl;
    if (l.scene.forceStrains.length === 0) return;
    const field = Math.max(0, lastUpTo(l.scene.forceStrains, strain));
    use(this.force);
    gl.uniform1i(this.force.at("discs"), 1);
    gl.uniform1f(this.force.at("width"), 0.0011 * Math.min(1, l.scene.forceMax[field] / l.forceScale));
    gl.uniform3fv(this.force.at("push"), this.colors.push);
    gl.uniform3fv(this.force.at("pull"), this.colors.pull);
    gl.bindVertexArray(l.forces);
    gl.bindBuffer(gl.ARRAY_BUFFER, l.forceBuffer);
    const n = l.scene.links.length / 2;
    gl.vertexAttribPointer(2, 1, gl.BYTE, false, 0, field * n);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, n);
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

  private upload(test: Test, scene: Scene): Loaded {
    const gl = this.gl;
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
    const c = test.cracks;
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
    return {
      test,
      scene,
      moves,
      table,
      discs: this.instances(
        { data: scene.discs, size: 3, type: gl.FLOAT },
        { data: tones(scene, test), size: 1, type: gl.UNSIGNED_BYTE },
      ).vao,
      forces: forces.vao,
      forceBuffer: forces.buffers[1],
      cracks: this.instances(
        { data: pairs, size: 2, type: gl.UNSIGNED_INT, integer: true },
        { data: shapes, size: 3, type: gl.FLOAT },
        { data: c.kind, size: 1, type: gl.UNSIGNED_BYTE },
      ).vao,
      range: ranges(scene),
      forceScale: Math.max(1e-30, ...scene.forceMax),
    };
  }
}
