// The page of `phyllite gui` where time, an answer or a file of another moment is needed: answers of the program are delayed or changed on
// their way to the page, and a calibration is laid down instead of computed. `make browser` runs it with the other pages.
import assert from "node:assert/strict";
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { assertFocusIsSeen, launch, showCommands, startGui, stopGui, within } from "./pages.mjs";

const folder = mkdtempSync(join(tmpdir(), "phyllite-gui-"));
const headings = "theta [deg];E [GPa];nu;UCS [MPa];DTS [MPa];specimen;depth of the core in the borehole;remark of the laboratory\n";
const table = `${headings}0;8,9;0,2;92,5;3,1;S1;12,5;dry\n45;7,3;0,25;56,5;;S2;13,1;dry\n90;53,6;0,21;102,5;;S3;14;dry\n`;
const calibrated = `name = "slate, the nearest model"\n[specimen]\nwidth = "8 mm"\nheight = "16 mm"\n[packing]\nn_grains = 330\n[matrix]\nsigma_c = "40 MPa"\ntau_c = "40 MPa"\n[[bedding]]\nspacing = "2 mm"\n[test]\nplaten_speed = "0.2 m/s"\nmax_strain = 2e-3\n`;
const verdict = {
  status: "out of reach",
  sentence: "out of reach: the search was short (it would be longer with a larger --max-tests in a new folder)",
  lines: ["tables.txt says which misses would pass"],
  findings: [{ kind: "nearest_in_maps", text: "flat joints may come nearer: --matrix flat_joint" }],
};

let browser;
let program;
let address;
const contexts = [];

before(async () => {
  writeFileSync(join(folder, "slate.csv"), table);
  writeFileSync(join(folder, "slate.toml"), `name = "slate"\ndata = "slate.csv"\n[columns]\n"specimen" = "-"\n"depth of the core in the borehole" = "-"\n"remark of the laboratory" = "-"\n`);
  mkdirSync(join(folder, "slate-calibration"));
  writeFileSync(join(folder, "slate-calibration/calibrated.toml"), calibrated);
  writeFileSync(join(folder, "slate-calibration/calibration.json"), JSON.stringify({ format: 2, rock: "slate", verdict }));
  writeFileSync(join(folder, "slate-calibration/tables.txt"), "UCS 12 % off\n");
  const started = startGui(folder);
  program = started.program;
  address = await started.address;
  browser = await launch();
});

after(async () => {
  for (const context of contexts) {
    for (const page of context.pages()) await page.unrouteAll({ behavior: "ignoreErrors" }); // answers that are still under way
    await context.close();
  }
  await browser?.close();
  await stopGui(program);
  rmSync(folder, { recursive: true, force: true });
});

/** A tab of its own, without drafts of the others. `changed` changes the answers about the rock before the page gets them. */
async function open({ changed, ...options } = {}) {
  const context = await browser.newContext({ viewport: { width: 1400, height: 900 }, permissions: ["clipboard-read", "clipboard-write"], ...options });
  contexts.push(context);
  await context.addInitScript(showCommands);
  const page = await context.newPage();
  page.setDefaultTimeout(15000);
  if (changed)
    await page.route("**/api/rock?*", async (route) => {
      const response = await route.fetch();
      await route.fulfill({ response, json: changed(await response.json()) });
    });
  await page.goto(address);
  await page.getByRole("heading", { name: "Table", exact: true }).waitFor();
  return page;
}

const cell = (page, line, column) => page.locator(`.sheet input[data-line="${line}"][data-column="${column}"]`);
const asText = async (page) => {
  if (await page.getByRole("button", { name: "Edit as text" }).isVisible()) await page.getByRole("button", { name: "Edit as text" }).click();
  const text = await page.getByRole("textbox", { name: "Table as text" }).inputValue();
  await page.getByRole("button", { name: "Edit as cells" }).click();
  return text;
};

async function paste(page, line, column, text) {
  await cell(page, line, column).focus();
  await page.evaluate((t) => navigator.clipboard.writeText(t), text);
  await page.keyboard.press("Control+V");
}

// --- what runs ------------------------------------------------------------------------------------------------

const progress = (more) => ({ state: "running", stage: "which model predicts what it has not seen", seconds: 0, n_done: 0, n_total: 0, model: [0, 1], stages: [0, 0, 0], seconds_left: null, said: [], parameters: [], ...more });
const seconds = async (page) => Number((await page.locator("#calibration .clock").textContent()).match(/\d+/)[0]);

test("a stage without a count has a moving bar, and the time goes on though the program writes nothing", async () => {
  const begun = Date.now() - 39000;
  const answer = (a) => ({ ...a, calibration: { ...a.calibration, state: "running", here: true, seconds: (Date.now() - begun) / 1000, progress: progress({}) } });
  const page = await open({ changed: answer });
  const bar = page.getByRole("progressbar", { name: "Tests of this stage" });
  await bar.waitFor();
  assert.equal(await bar.evaluate((b) => b.matches(":indeterminate")), true);
  const first = await seconds(page);
  assert.ok(first >= 39 && first < 60, String(first));
  await page.route("**/api/rock?*", () => {}); // no more answers
  await within(10, async () => (await seconds(page)) >= first + 3);
});

test("a stage with a count shows how far it is; before the first word of a calibration the one before is not shown", async () => {
  let now = progress({ n_done: 3, n_total: 12 });
  const page = await open({ changed: (a) => ({ ...a, calibration: { ...a.calibration, state: "running", here: true, seconds: 5, progress: now } }) });
  await page.getByText("3 of 12 tests of this stage.").waitFor();
  assert.equal(await page.getByRole("progressbar", { name: "Tests of this stage" }).evaluate((b) => b.value / b.max), 0.25);
  now = progress({ state: "stopped", stage: "of the run before", n_done: 9, n_total: 9 });
  await within(8, async () => !(await page.getByText("3 of 12 tests").isVisible()));
  assert.equal(await page.getByText("of the run before").isVisible(), false);
  assert.equal(await page.getByRole("progressbar", { name: "Tests of this stage" }).evaluate((b) => b.matches(":indeterminate")), true);
});

test("a test that runs has a clock and a bar", async () => {
  const running = { name: "pull", state: "running", command: "phyllite run", log: "", exit_code: null, seconds: 12, files: [], specimens: [] };
  const page = await open({ changed: (a) => ({ ...a, tests: [running] }) });
  const article = page.getByRole("article", { name: "Test pull" });
  await article.getByText(/1[2-9] s so far/).waitFor();
  assert.equal(await article.getByRole("progressbar").evaluate((b) => b.matches(":indeterminate")), true);
});

test("what speaks against a number is said as a reason", async () => {
  const notes = ["kinetic_ratio 0.021, above 0.01: the specimen is in motion, not in equilibrium"];
  const specimen = { specimen: "intact", theta: null, status: "peaked", strength: "UCS", value: 4e7, unit: "Pa", grade: "warning", notes };
  const ended = { name: "press", state: "finished", command: "phyllite run", log: "", exit_code: 0, seconds: null, files: [], specimens: [specimen] };
  const page = await open({ changed: (a) => ({ ...a, tests: [ended] }) });
  const row = page.getByRole("article", { name: "Test press" }).getByRole("row", { name: /intact/ });
  assert.match(await row.textContent(), /40\.00 MPa, warning\s*the specimen is in motion, not in equilibrium \(kinetic ratio 0\.021, above 0\.01\)/);
  assert.equal(await page.getByRole("article", { name: "Test press" }).getByRole("progressbar").isVisible(), false);
});

// --- the table ------------------------------------------------------------------------------------------------

for (const [width, colorScheme] of [[390, "light"], [1400, "dark"], [1920, "light"]])
  test(`messages of a wide table are read without scrolling it, ${width} px`, async () => {
    const page = await open({ viewport: { width, height: 900 }, colorScheme });
    await cell(page, 2, 1).fill("7,3 or perhaps 7,4");
    const says = page.locator(".sheet .says p");
    await says.first().waitFor();
    const [sheet, word] = [await page.locator(".sheet").boundingBox(), await says.first().boundingBox()];
    assert.ok(await page.locator(".sheet").evaluate((s) => s.scrollWidth > s.clientWidth) || width > 1400, "the table is wider than its box");
    assert.ok(word.x >= sheet.x && word.x + word.width <= sheet.x + sheet.width, JSON.stringify([sheet, word]));
    await page.locator(".sheet").evaluate((s) => (s.scrollLeft = 200));
    const after = await says.first().boundingBox();
    assert.ok(after.x >= sheet.x && after.x + after.width <= sheet.x + sheet.width, "and after scrolling");
  });

test("a block that begins with headings takes the headings' place wherever it is pasted; Undo brings the old table back", async () => {
  const page = await open();
  const before = await asText(page);
  const blocks = [
    "theta [deg]\tE [GPa]\tUCS [MPa]\r\n0\t8,1\t92\r\n90\t50\t101\r\n",
    "Core 7, Aberfoyle\t\t\r\nWinkel\tE-Modul\tDruckfestigkeit\r\n0\t8,1\t92\r\n90\t50\t101\r\n",
    "theta\tE\tUCS\r\n[deg]\t[GPa]\t[MPa]\r\n0\t8,1\tn.b.\r\n90\t50\t101\r\n",
  ];
  for (const pasted of blocks)
    for (const [line, column] of [[1, 0], [2, 3], [0, 0], [4, 0]]) {
      await paste(page, line, column, pasted);
      await page.getByText("Undo brings the old one back").waitFor();
      const text = await asText(page);
      const rows = text.trim().split("\n").filter((l) => !l.startsWith("#"));
      assert.equal(rows[0].split(/[;\t]/)[1].slice(0, 1), "E", text);
      assert.equal(rows.length, pasted.trim().split("\r\n").length - (pasted.startsWith("Core") ? 1 : 0), text);
      assert.ok(!text.includes("56,5"), "no row of the old table is left between");
      await page.getByRole("button", { name: "Undo" }).click();
      assert.equal(await asText(page), before);
      assert.equal(await page.getByText("Undo brings the old one back").isVisible(), false);
    }
});

test("a block without headings goes where it is pasted", async () => {
  const page = await open();
  const blocks = ["8,1\t0,3\n7,7\t0,31", "n.b.\tn.m.\n7,7\t0,31", "n.b.\t0,3\n7,7\t0,31"];
  for (const pasted of blocks) {
    await paste(page, 1, 1, pasted);
    const [first] = pasted.split("\n")[0].split("\t");
    await within(5, async () => (await cell(page, 1, 1).inputValue()) === first);
    assert.deepEqual([await cell(page, 2, 1).inputValue(), await cell(page, 2, 2).inputValue(), await cell(page, 0, 1).inputValue()], ["7,7", "0,31", "E [GPa]"]);
    assert.equal(await cell(page, 3, 3).inputValue(), "102,5");
    await page.getByRole("button", { name: "Undo" }).click();
  }
  await paste(page, 2, 3, "UCS [MPa]\n80\n90\n95"); // one column, wherever in it
  await within(5, async () => (await cell(page, 1, 3).inputValue()) === "80");
  assert.deepEqual([await cell(page, 0, 3).inputValue(), await cell(page, 3, 3).inputValue(), await cell(page, 3, 0).inputValue()], ["UCS [MPa]", "95", "90"]);
  await page.getByRole("button", { name: "Undo" }).click();
  await paste(page, 0, 7, "BTS [MPa]\tn\n4,1\t3"); // on the headings: columns are added
  await within(5, async () => (await cell(page, 1, 8).inputValue()) === "3");
  assert.equal(await cell(page, 3, 3).inputValue(), "102,5");
});

test("the answer to an older text is never shown as that to the text that stands there", async () => {
  const page = await open();
  await page.getByText("No problems").waitFor();
  const asked = [];
  await page.route("**/api/check", async (route) => {
    const answer = await route.fetch();
    await new Promise((go) => asked.push(go));
    await route.fulfill({ response: answer });
  });
  const wrong = cell(page, 1, 1);
  await wrong.fill("abc");
  await within(10, () => asked.length === 1);
  const seen = await page.evaluateHandle(() => {
    const words = new Set();
    const look = () => words.add(`${document.querySelector("#check .state").textContent}`);
    new MutationObserver(look).observe(document.querySelector("#check .state"), { childList: true, subtree: true, characterData: true });
    return words;
  });
  await wrong.fill("9,1");
  asked[0](); // within the time in which the page waits for more typing
  await within(10, () => asked.length === 2);
  assert.match(await page.locator("#check .state").textContent(), /Checking/);
  asked[1]();
  await within(10, async () => (await page.locator("#check .state").textContent()).trim() === "No problems in the table and the rock file.");
  const words = await seen.evaluate((w) => [...w]);
  assert.ok(!words.some((w) => w.includes("to mend")), words.join(" | "));
  assert.equal(await wrong.getAttribute("aria-invalid"), null);
});

// --- words ----------------------------------------------------------------------------------------------------

test("the page names its fields and not options of commands; files that are named can be opened", async () => {
  const page = await open();
  await page.getByText("it would be longer with a larger “Largest number of tests”").waitFor();
  const link = page.getByRole("link", { name: "tables.txt", exact: true }).first();
  assert.match(await link.getAttribute("href"), /^\/files\/slate-calibration\/tables\.txt\?/);
  await page.locator("#calibration details summary").first().click();
  const said = await page.locator("#calibration .notice, #calibration .findings").allTextContents();
  assert.ok(!/--[a-z]/.test(said.join(" ")), said.join(" "));
  await page.getByLabel("Largest number of tests").fill("20");
  await page.getByRole("button", { name: "Calibrate anew" }).click();
  const alert = page.locator("#calibration .objection").filter({ hasText: /\w/ });
  await within(15, async () => (await alert.allTextContents()).join().includes("at least"));
  assert.match((await alert.allTextContents()).join(), /“Largest number of tests” = 20: expected at least \d+/);
  assert.ok(!/--|command line/.test((await alert.allTextContents()).join()));
  const options = await page.locator("#rock-file option").allTextContents();
  assert.ok(!options.some((o) => o.includes("not said") || o.includes("_")), options.join(", "));
});

test("a confined test is found by its common name, asks for MPa and refuses none", async () => {
  const page = await open();
  const kind = page.getByLabel("Kind of test");
  await kind.selectOption({ label: "triaxial / confined (biaxial)" });
  const stress = page.getByRole("textbox", { name: "Confining stress [MPa]" });
  assert.equal(await stress.inputValue(), "");
  await within(10, async () => (await page.getByRole("textbox", { name: "Recipe" }).inputValue()).includes('kind = "biaxial"'));
  await page.locator(".objection", { hasText: "expected a stress above 0, such as 10 MPa" }).first().waitFor();
  for (const none of ["0", "0 MPa", "0,0"]) {
    await stress.fill(none);
    await within(10, async () => (await stress.getAttribute("aria-invalid")) === "true");
    await page.getByRole("button", { name: "Run the test" }).click();
    await page.getByText("some values above are wrong; mend them first").waitFor();
  }
  for (const [given, wanted] of [["10", "10 MPa"], ["2,5", "2.5 MPa"], ["0.02 GPa", "20 MPa"]]) {
    await stress.fill(given);
    await within(10, async () => (await page.getByRole("textbox", { name: "Recipe" }).inputValue()).includes(`confining_stress = "${wanted}"`) || (await page.getByRole("textbox", { name: "Recipe" }).inputValue()).includes(`confining_stress = "${given}"`));
    assert.equal(await stress.getAttribute("aria-invalid"), "false");
  }
  await page.getByRole("textbox", { name: "Recipe" }).fill((await page.getByRole("textbox", { name: "Recipe" }).inputValue()).replace(/confining_stress = "[^"]*"/, 'confining_stress = "0 MPa"'));
  await page.getByRole("button", { name: "Run the test" }).click(); // by hand, too
  await page.locator("#tests .objection", { hasText: "a stress above 0" }).first().waitFor();
});

test("wherever the focus is, it is seen", async () => {
  const page = await open();
  await page.getByText("No problems").waitFor();
  await page.evaluate(() => document.activeElement.blur());
  await assertFocusIsSeen(page, 120);
});
