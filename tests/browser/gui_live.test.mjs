// The specimen in the press on the page of `phyllite gui`: drawn by WebGL and on a plain canvas, moving on, soon enough, in both themes.
// What is in the press is written here instead of computed; gui.test.mjs has one that breaks indeed. `make browser` runs it.
import assert from "node:assert/strict";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { launch, startGui, stopGui, within } from "./pages.mjs";

const folder = mkdtempSync(join(tmpdir(), "phyllite-live-"));
let browser;
let program;
let address;

before(async () => {
  writeFileSync(join(folder, "slate.csv"), "theta [deg],E [GPa],UCS [MPa]\n0,9,92\n45,7,56\n90,53,102\n");
  writeFileSync(join(folder, "slate.toml"), `name = "slate"\ndata = "slate.csv"\n`);
  const started = startGui(folder);
  program = started.program;
  address = await started.address;
  browser = await launch();
});

after(async () => {
  await browser?.close();
  await stopGui(program);
  rmSync(folder, { recursive: true, force: true });
});

const packed = (numbers) => Buffer.from(numbers.buffer).toString("base64");
const kinds = ["matrix, tension", "matrix, shear", "bedding, tension", "bedding, shear"];

/** Equal discs in rows across 20 x 40 mm, shifted to the right by `moved` [mm]; cracks between neighbours, of all kinds in turn. */
function press(n, nCracks, more = {}) {
  const [columns, size] = [Math.round(Math.sqrt(n / 2)), 4 / 60000];
  const step = 20 / columns;
  const discs = Array.from({ length: n }, (_, i) => [((i % columns) + 0.5) * step - 10, (Math.floor(i / columns) + 0.5) * step - 20, 0.5 * step]).flat();
  const cracks = Array.from({ length: nCracks }, (_, i) => (7 * i) % (n - columns));
  return {
    format: 1,
    specimen: "theta = 30 deg",
    test: "uniaxial",
    "width [m]": 0.02,
    "height [m]": 0.04,
    bedding: [{ theta: 30, spacing: 0.004, offset: 0 }],
    crack_kinds: kinds,
    "disc_quantum [m]": size * 1e-2,
    discs: packed(Int16Array.from(discs, (v) => Math.round(v / size / 10))),
    jointed: packed(Uint8Array.from({ length: n }, (_, i) => (i % 9 === 0 ? 1 : 0))),
    over: false,
    strain: [0, 1e-3, 2e-3],
    "stress [Pa]": [0, 2e7, 4e7],
    "displacement_quantum [m]": 1e-6,
    moves: packed(Int16Array.from({ length: 2 * n }, (_, i) => (i % 2 === 0 ? 1000 * (more.moved ?? 0) : 0))),
    cracks: { pairs: packed(Uint32Array.from(cracks.flatMap((c) => [c, c + 1]))), shapes: packed(Int16Array.from(cracks.flatMap(() => [32767, 0, Math.round(step / size / 10)]))), kinds: packed(Uint8Array.from(cracks, (_, i) => i % 4)) },
  };
}

/** A tab in which a calibration runs, with `now()` in the press. `flat`: without WebGL 2, or null as the page chooses here. */
async function open(now, { flat = false, ...options } = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, ...options });
  const page = await context.newPage();
  page.setDefaultTimeout(15000);
  page.trouble = [];
  page.on("console", (m) => ["error", "warning"].includes(m.type()) && !m.text().includes("GPU stall") && page.trouble.push(m.text()));
  page.on("pageerror", (e) => page.trouble.push(String(e)));
  if (flat !== null)
    await page.addInitScript((none) => {
      if (none) HTMLCanvasElement.prototype.getContext = new Proxy(HTMLCanvasElement.prototype.getContext, { apply: (get, canvas, [kind, ...rest]) => (kind === "webgl2" ? null : Reflect.apply(get, canvas, [kind, ...rest])) });
      else WebGL2RenderingContext.prototype.getParameter = new Proxy(WebGL2RenderingContext.prototype.getParameter, { apply: (get, gl, [name]) => (name === 0x9246 ? "a graphics processor" : Reflect.apply(get, gl, [name])) });
    }, flat);
  const progress = { state: "running", stage: "strength search", seconds: 5, n_done: 3, n_total: 12, model: [0, 1], stages: [0, 0, 0], seconds_left: null, said: [], parameters: [] };
  await page.route("**/api/rock?*", async (route) => {
    const answer = await (await route.fetch()).json();
    await route.fulfill({ json: { ...answer, calibration: { ...answer.calibration, state: "running", here: true, seconds: 5, progress } } });
  });
  await page.route("**/api/press?*", (route) => route.fulfill({ json: now() }));
  await page.goto(address);
  return page;
}

async function close(page) {
  await page.unrouteAll({ behavior: "ignoreErrors" }); // answers that are still under way
  await page.context().close();
}

const specimen = (page) => page.getByRole("img", { name: "Specimen in the press" });

/** Pixels of the canvas by the colour of the page that is nearest: grains and kinds of cracks; and the first column with any. */
const pixels = (page) =>
  specimen(page).evaluate(async (canvas) => {
    await new Promise((done) => requestAnimationFrame(() => setTimeout(done, 350)));
    const flat = document.createElement("canvas").getContext("2d");
    [flat.canvas.width, flat.canvas.height] = [canvas.width, canvas.height];
    flat.drawImage(canvas, 0, 0);
    const style = getComputedStyle(document.documentElement);
    const names = ["grain-0", "grain-1", "grain-2", "crack-0", "crack-1", "crack-2", "crack-3"];
    const colors = names.map((n) => parseInt(style.getPropertyValue(`--${n}`).trim().slice(1), 16));
    const count = Object.fromEntries(names.map((n) => [n, 0]));
    const data = flat.getImageData(0, 0, canvas.width, canvas.height).data;
    let [left, inked] = [canvas.width, 0];
    for (let i = 0; i < data.length; i += 4) {
      if (data[i + 3] < 250) continue;
      left = Math.min(left, (i / 4) % canvas.width);
      ++inked;
      const off = colors.map((c) => Math.abs(((c >> 16) & 255) - data[i]) + Math.abs(((c >> 8) & 255) - data[i + 1]) + Math.abs((c & 255) - data[i + 2]));
      const best = off.indexOf(Math.min(...off));
      if (off[best] < (best < 3 ? 60 : 120)) ++count[names[best]]; // edges of cracks are mixed with grains
    }
    return { ...count, left, inked };
  });

for (const flat of [false, true])
  for (const colorScheme of ["light", "dark"])
    test(`the specimen is drawn ${flat ? "on a plain canvas" : "by WebGL"}, ${colorScheme}; what breaks and moves is seen`, async () => {
      let now = press(1250, 0);
      const page = await open(() => now, { flat, colorScheme });
      await page.getByRole("heading", { name: "In the press: uniaxial, θ = 30°" }).waitFor();
      const whole = await pixels(page);
      assert.equal(await specimen(page).evaluate((canvas) => canvas.getContext("webgl2") !== null), !flat);
      for (const grain of ["grain-0", "grain-1", "grain-2"]) assert.ok(whole[grain] > 300, JSON.stringify(whole));
      for (const kind of [0, 1, 2, 3]) assert.ok(whole[`crack-${kind}`] < 40, JSON.stringify(whole));
      now = press(1250, 400, { moved: 1 });
      await page.getByText("matrix, tension: 100").waitFor();
      const broken = await pixels(page);
      for (const kind of [0, 1, 2, 3]) assert.ok(broken[`crack-${kind}`] > 100, JSON.stringify(broken));
      assert.ok(broken.left >= whole.left + 5, `moved by a twentieth of its width: ${whole.left}, ${broken.left}`);
      await page.getByRole("button", { name: "Light or dark" }).click(); // drawn anew in the other colours
      const other = await pixels(page);
      for (const grain of ["grain-0", "grain-1"]) assert.ok(other[grain] > 300, JSON.stringify(other));
      assert.deepEqual(page.trouble, []);
      await close(page);
    });

test("both ways of drawing show the same", async () => {
  const [a, b] = [await open(() => press(1250, 200)), await open(() => press(1250, 200), { flat: true })];
  const [gl, flat] = [await pixels(a), await pixels(b)];
  for (const name of ["inked", "crack-0", "crack-1", "crack-2", "crack-3"]) assert.ok(Math.abs(gl[name] - flat[name]) <= 0.25 * Math.max(gl[name], flat[name]), `${name}: ${gl[name]} by WebGL, ${flat[name]} without`); // grains have a rim by WebGL alone
  assert.ok(Math.abs(gl.left - flat.left) <= 1, `${gl.left}, ${flat.left}`);
  await close(a);
  await close(b);
});

test("the curve grows from its beginning on axes that stay, also when the next specimen begins", async () => {
  const curve = (n, top) => ({ ...press(200, 0), strain: Array.from({ length: n }, (_, i) => 1e-4 * (i + 1)), "stress [Pa]": Array.from({ length: n }, (_, i) => (top * 1e6 * (i + 1)) / n) });
  let now = curve(30, 55);
  const page = await open(() => now);
  const chart = page.getByRole("img", { name: "Stress and strain in the press" });
  await chart.waitFor();
  const state = () => chart.evaluate((svg) => ({ ticks: [...svg.querySelectorAll('[aria-label*="tick label"] text')].map((t) => t.textContent).join(" "), line: svg.querySelector('[aria-label="line"] path').getAttribute("d") }));
  const seen = [await state()];
  for (const next of [curve(34, 61), curve(41, 72), curve(2, 4)]) {
    now = next;
    await within(8, async () => (await state()).line !== seen.at(-1).line);
    seen.push(await state());
  }
  assert.deepEqual([...new Set(seen.map((s) => s.ticks))].length, 1, seen.map((s) => s.ticks).join(" | "));
  now = { ...curve(3, 5), over: true };
  await page.getByRole("heading", { name: "In the press, at its end: uniaxial, θ = 30°" }).waitFor();
  now = null; // between two stages: the last picture stays
  await page.waitForTimeout(700);
  assert.ok(await specimen(page).isVisible());
  await close(page);
});

test("7,481 discs: ten pictures a second and more, without a graphics processor", async (t) => {
  const page = await open(() => press(7442, 1500), { flat: null });
  await specimen(page).waitFor();
  await page.waitForTimeout(1000);
  const perSecond = await specimen(page).evaluate((canvas) => {
    const times = [];
    const gl = canvas.getContext("webgl2") ?? canvas.getContext("2d");
    const wait = () => (gl.readPixels ? gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)) : gl.getImageData(0, 0, 1, 1));
    for (let i = 0; i < 30; ++i) {
      const start = performance.now();
      window.phylliteLive.forEach((p) => p.drawNow());
      wait(); // until it is drawn indeed
      times.push(performance.now() - start);
    }
    return 1000 / Math.min(...times); // what else runs on the machine has no say
  });
  t.diagnostic(`${perSecond.toFixed(0)} pictures a second`);
  assert.ok(perSecond >= 10, `${perSecond}`);
  await close(page);
});

for (const width of [390, 820, 1920])
  test(`nothing sticks out at ${width} px; specimen and curve stand beside or below each other`, async () => {
    const page = await open(() => press(1250, 100), { viewport: { width, height: 900 } });
    await specimen(page).waitFor();
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
    const [a, b] = [await specimen(page).boundingBox(), await page.getByRole("img", { name: "Stress and strain in the press" }).boundingBox()];
    assert.ok(width < 560 ? b.y >= a.y + a.height - 1 : b.x >= a.x + a.width - 1, JSON.stringify([a, b]));
    assert.ok(a.height >= 200 && a.height <= 520, String(a.height));
    await close(page);
  });
