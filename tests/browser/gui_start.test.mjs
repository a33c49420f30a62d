// The first screen of `phyllite gui` and the ways that lead to a rock: a trial, a pasted table, a file, an address, a program that was
// started again. `make browser` runs it with the other pages.
import assert from "node:assert/strict";
import { chmodSync, existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { delimiter, join } from "node:path";
import { after, before, test } from "node:test";
import { assertFocusIsSeen, launch, showCommands, startGui, stopGui, within } from "./pages.mjs";

const above = mkdtempSync(join(tmpdir(), "phyllite-start-"));
const copied = "theta [deg]\tE [GPa]\tUCS [MPa]\r\n0\t8,9\t92,5\r\n45\t7,3\t56\r\n90\t53,6\t102,5\r\n";
const seeds = new URL("../fuzz/seeds/workbook/", import.meta.url).pathname;
const programs = [];
let browser;

before(async () => {
  browser = await launch();
});
after(async () => {
  await browser?.close();
  for (const program of programs) await stopGui(program);
  rmSync(above, { recursive: true, force: true });
});

/** A folder of its own with a program in it, and a tab. */
async function open({ files = {}, commands = true, ...options } = {}) {
  const folder = mkdtempSync(join(above, "rocks-"));
  for (const [name, text] of Object.entries(files)) {
    mkdirSync(join(folder, name, ".."), { recursive: true });
    writeFileSync(join(folder, name), text);
  }
  const started = startGui(folder);
  programs.push(started.program);
  const address = await started.address;
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, permissions: ["clipboard-read", "clipboard-write"], ...options });
  if (commands) await context.addInitScript(showCommands);
  const page = await context.newPage();
  page.setDefaultTimeout(15000);
  page.trouble = [];
  page.on("console", (m) => ["error", "warning"].includes(m.type()) && !/GPU stall|ERR_CONNECTION_REFUSED/.test(m.text()) && page.trouble.push(m.text()));
  page.on("pageerror", (e) => page.trouble.push(String(e)));
  await page.goto(address);
  await page.getByRole("heading", { name: "Rocks", level: 2 }).waitFor();
  return { page, folder, address, program: started.program, file: (name) => readFileSync(join(folder, name), "utf8"), close: () => context.close().then(() => stopGui(started.program)) };
}

const slate = { "slate.csv": "theta [deg],E [GPa],UCS [MPa]\n0,9,92\n45,7,56\n90,53,102\n", "slate.toml": `name = "slate"\ndata = "slate.csv"\n` };
const other = { "gneiss.csv": slate["slate.csv"], "gneiss.toml": `name = "gneiss"\ndata = "gneiss.csv"\n` };
const title = (page, name) => page.getByRole("heading", { name, level: 1, exact: true }).waitFor();
const cell = (page, heading, row) => page.getByLabel(new RegExp(`^${heading.replace(/[[\]]/g, "\\$&")}, line \\d+$`)).nth(row - 1);

async function paste(page, text) {
  await page.evaluate((t) => navigator.clipboard.writeText(t), text);
  await page.keyboard.press("Control+V");
}

test("one click: a measured shale is calibrated, and breaks on the page", async () => {
  const { page, file, close } = await open();
  await page.getByRole("button", { name: "Try Boryeong shale" }).click();
  await title(page, "boryeong-shale");
  await page.getByText("Running.", { exact: true }).waitFor();
  await page.getByRole("img", { name: "Specimen in the press" }).waitFor({ timeout: 120000 });
  assert.match(file("boryeong-shale.toml"), /grain_size = "1.66 mm"/);
  assert.match(file("boryeong-shale.csv"), /^theta \[deg\],UCS/);
  await page.getByText(/^phyllite calibrate boryeong-shale.toml .*--effort quick/).waitFor();
  await page.getByRole("button", { name: "Stop", exact: true }).click();
  await page.getByText("Stopped; what is finished is kept.").first().waitFor({ timeout: 30000 });
  assert.deepEqual(page.trouble, []);
  await close();
});

test("from an empty folder to a calibrated rock and a predicted confined strength in ten actions, by visible labels", async () => {
  const { page, close } = await open({ commands: false, viewport: { width: 1280, height: 900 } });
  let actions = 0;
  const act = (done) => (++actions, done);
  await act(page.getByRole("button", { name: "Try Boryeong shale" }).click());
  await page.getByText("Finished.", { exact: true }).first().waitFor({ timeout: 540000 });
  assert.equal(await page.getByText(/^phyllite /).filter({ visible: true }).count(), 0, "no command is in sight");
  await act(page.getByRole("link", { name: /^Test/ }).click());
  await act(page.getByLabel("Kind of test").selectOption({ label: "triaxial / confined (biaxial)" }));
  await act(page.getByRole("textbox", { name: "Confining stress [MPa]" }).fill("10"));
  await act(page.getByRole("textbox", { name: "Angles" }).fill("45"));
  await act(page.getByRole("button", { name: "Run the test" }).click());
  const test = page.getByRole("article", { name: /biaxial/ });
  await test.getByText("Finished.").waitFor({ timeout: 300000 });
  assert.match(await test.getByRole("table").innerText(), /\d MPa/);
  await act(page.getByRole("link", { name: /^Results/ }).click());
  await page.getByRole("img", { name: /σ_1.*all results/ }).first().waitFor({ timeout: 20000 });
  assert.ok(actions <= 10, String(actions));
  assert.deepEqual(page.trouble, []);
  await close();
});

test("before a calibration its minutes, tests and errors are said; another grain size changes them", async () => {
  const { page, file, close } = await open();
  await page.getByRole("button", { name: "Begin with its table" }).click();
  const calibration = page.getByRole("region", { name: "Calibration", exact: true });
  await calibration.getByText("To be expected:").waitFor({ timeout: 30000 });
  const effort = calibration.getByLabel("Effort of the search");
  assert.match((await effort.locator("option").allInnerTexts()).join(), /quick: .*(s|min|h).*thorough: /);
  const said = () => calibration.locator(".comes-to").innerText();
  assert.match(await said(), /^\d+ to \d+ tests, /);
  const before = await said();
  await effort.selectOption("quick");
  assert.notEqual(await said(), before);
  const quick = await said();
  await calibration.getByLabel("Grain size of the model [mm]").fill("1,66");
  await within(20, async () => (await said()) !== quick);
  await page.getByRole("button", { name: "Save", exact: true }).click();
  await within(10, () => /^grain_size = "1.66 mm"$/m.test(file("boryeong-shale.toml")));
  await close();
});

test("a table pasted on the first screen becomes a rock, its headings in their place", async () => {
  const { page, file, close } = await open();
  await paste(page, copied);
  await title(page, "rock");
  assert.equal(await cell(page, "UCS [MPa]", 2).inputValue(), "56");
  await page.getByText("No problems").waitFor();
  assert.equal(file("rock.csv"), "theta [deg]\tE [GPa]\tUCS [MPa]\n0\t8,9\t92,5\n45\t7,3\t56\n90\t53,6\t102,5\n".replaceAll("\t", ";"));
  await page.evaluate(() => document.activeElement.blur());
  await paste(page, copied.replace("92,5", "93,5")); // beside all fields: into the table that is open
  await within(5, async () => (await cell(page, "UCS [MPa]", 1).inputValue()) === "93,5");
  await page.getByRole("button", { name: "Undo" }).click();
  assert.equal(await cell(page, "UCS [MPa]", 1).inputValue(), "92,5");
  assert.deepEqual(page.trouble, []);
  await close();
});

test("a table pasted before the program has answered becomes a rock as soon as it has", async () => {
  const { page, close } = await open();
  await page.route("**/api/project*", (route) => setTimeout(() => route.continue(), 1500));
  await page.reload();
  await page.evaluate((text) => {
    const clipboardData = new DataTransfer();
    clipboardData.setData("text/plain", text);
    document.body.dispatchEvent(new ClipboardEvent("paste", { clipboardData, bubbles: true, cancelable: true }));
  }, copied);
  await title(page, "rock");
  await page.getByText("No problems").waitFor();
  assert.deepEqual(page.trouble, []);
  await close();
});

test("files are dropped or chosen: a workbook, a CSV file; what is none is refused", async () => {
  const { page, file, folder, close } = await open();
  const drop = (name, bytes) =>
    page.evaluate(
      ([name, text]) => {
        const data = new DataTransfer();
        data.items.add(new File([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))], name));
        document.body.dispatchEvent(new DragEvent("drop", { dataTransfer: data, bubbles: true, cancelable: true }));
      },
      [name, Buffer.from(bytes).toString("base64")],
    );
  await drop("picture.xlsx", "no workbook");
  await within(10, async () => (await page.getByRole("alert").allTextContents()).join("").length > 10);
  await drop("Cores 2024.xlsx", readFileSync(join(seeds, "openpyxl.xlsx")));
  await title(page, "Cores 2024");
  assert.ok(file("Cores 2024.csv").split("\n").length > 2, file("Cores 2024.csv"));
  await page.getByText(/No problems|to mend/).first().waitFor();
  await page.getByText("Another rock").click();
  writeFileSync(join(folder, "..", "chosen.csv"), slate["slate.csv"]);
  await page.getByLabel("Choose a file").setInputFiles(join(folder, "..", "chosen.csv"));
  await title(page, "chosen");
  assert.equal(file("chosen.csv"), slate["slate.csv"]);
  await page.getByText("Another rock").click();
  await page.getByLabel("Choose a file").setInputFiles(join(folder, "..", "chosen.csv"));
  await title(page, "chosen-2"); // nothing is written over
  await close();
});

test("a rock begins with the table of a measured one", async () => {
  const { page, file, close } = await open();
  await page.getByLabel("Measured rock", { exact: true }).selectOption("th26-shale");
  await page.getByRole("button", { name: "Begin with its table" }).click();
  await title(page, "th26-shale");
  assert.match(file("th26-shale.toml"), /data = "th26-shale.csv"/);
  await page.getByText("No problems").waitFor();
  await close();
});

test("rocks and tests have addresses: reload, another tab, Back", async () => {
  const { page, address, close } = await open({ files: { ...slate, ...other } });
  await page.getByRole("button", { name: "slate" }).click();
  await title(page, "slate");
  await page.getByRole("button", { name: "gneiss" }).click();
  await title(page, "gneiss");
  await page.reload();
  await title(page, "gneiss");
  await page.getByRole("link", { name: "Calibration" }).click();
  await page.goBack(); // the anchor
  await page.goBack();
  await title(page, "slate");
  await page.goForward();
  await title(page, "gneiss");
  const second = await page.context().newPage();
  await second.goto(page.url());
  await title(second, "gneiss");
  await second.goto(`${address}&rock=granite`);
  await second.getByText("There is no rock granite in this folder.").waitFor();
  await close();
});

const finished = (status, ucs) => JSON.stringify({ format: 2, rock: "slate", fitted: [], verification: [], left_out: [], effort: "quick", verdict: { status, sentence: `The sentence of ${status}.`, lines: [], findings: [] }, errors: [{ of: "packings of the fit", UCS: 0.5 }, { of: "15 unseen packings", UCS: ucs, nu: 0.031 }] });
const model = `name = "slate"\n[specimen]\nwidth = "8 mm"\nheight = "16 mm"\n[packing]\nn_grains = 330\n[[bedding]]\nspacing = "2 mm"\n[test]\nplaten_speed = "0.2 m/s"\n`;

test("all calibrations of a rock stand in a list; a stopped one hides no finished one; each is tested", async () => {
  const files = {
    ...slate,
    "slate-calibration/calibration.json": finished("calibrated", 0.04),
    "slate-calibration/calibrated.toml": model,
    "slate-calibration-2/calibration.json": finished("out of reach", 0.21),
    "slate-calibration-2/calibrated.toml": model.replace("330", "340"),
    "slate-calibration-3/.progress.json": JSON.stringify({ state: "stopped", stage: "", seconds: 3, n_done: 0, n_total: 0, model: [0, 1], stages: [0, 0, 0], seconds_left: null, said: [], parameters: [] }),
  };
  const { page, close } = await open({ files });
  const list = page.getByRole("table", { name: "Calibrations of this rock" });
  const rows = await list.getByRole("row").allTextContents();
  assert.equal(rows.length, 4);
  assert.match(rows[1], /^slate-calibration-3.*stopped/);
  assert.match(rows[2], /out of reach.*UCS 21\.0\s%, nu 0\.031/);
  assert.match(rows[3], /^slate-calibration[^-].*finished.*quick.*calibrated.*UCS 4\.0/);
  await page.getByText("Stopped; what is finished is kept.").waitFor();
  const base = page.getByLabel("Calibration that is tested");
  assert.equal(await base.inputValue(), "slate-calibration-2", "the newest with a model");
  await within(10, async () => (await page.getByRole("textbox", { name: "Recipe" }).inputValue()).includes("n_grains = 340"));
  await list.getByRole("button", { name: "slate-calibration", exact: true }).click();
  await page.getByText("The sentence of calibrated.").waitFor();
  assert.equal(await list.getByRole("button", { name: "slate-calibration", exact: true }).getAttribute("aria-current"), "true");
  await within(10, async () => (await page.getByRole("textbox", { name: "Recipe" }).inputValue()).includes("n_grains = 330"));
  await base.selectOption("slate-calibration-2");
  await within(10, async () => (await page.getByRole("textbox", { name: "Recipe" }).inputValue()).includes("n_grains = 340"));
  await page.reload(); // the address names the calibration
  await page.getByText("The sentence of calibrated.").waitFor();
  await page.goBack();
  await page.getByText("Stopped; what is finished is kept.").waitFor();
  assert.deepEqual(page.trouble, []);
  await close();
});

test("a calibration begun anew stands in the list while it runs; the finished one stays open to tests", async () => {
  const { page, close } = await open({ files: { ...slate, "slate-calibration/calibration.json": finished("calibrated", 0.04), "slate-calibration/calibrated.toml": model } });
  await page.getByText("The sentence of calibrated.").waitFor();
  await page.getByRole("button", { name: "Calibrate anew" }).click();
  const list = page.getByRole("table", { name: "Calibrations of this rock" });
  await within(20, async () => /^slate-calibration-2.*running/.test((await list.getByRole("row").allTextContents())[1] ?? ""));
  await page.getByText("Running.", { exact: true }).waitFor();
  assert.ok(await page.getByRole("button", { name: "Run the test" }).isVisible());
  await list.getByRole("button", { name: "slate-calibration", exact: true }).click();
  await page.getByText("The sentence of calibrated.").waitFor();
  assert.ok(await page.getByRole("button", { name: "Calibrate anew" }).isDisabled(), "one at a time");
  await list.getByRole("button", { name: "slate-calibration-2" }).click();
  await page.getByRole("button", { name: "Stop", exact: true }).click();
  await page.getByText("Stopped; what is finished is kept.").first().waitFor({ timeout: 30000 });
  await close();
});

test("an open tab goes on when the program is started again; the file that leads in is this user's alone", async () => {
  const { page, folder, address, program, close } = await open({ files: slate });
  await page.getByLabel("E [GPa], line 2").fill("10");
  await stopGui(program);
  await page.getByText("The program has been stopped.").waitFor();
  const again = startGui(folder, new URL(address).port);
  programs.push(again.program);
  assert.equal(await again.address, address, "the same token");
  await page.getByText("The program has been stopped.").waitFor({ state: "hidden" });
  await page.getByRole("button", { name: "Save", exact: true }).click();
  await page.getByText("slate: saved").waitFor();
  const way = join(folder, "open-phyllite.html");
  assert.equal(statSync(way).mode & 0o777, 0o600);
  const tab = await page.context().newPage();
  await tab.goto(`file://${way}`);
  await title(tab, "slate");
  const { file_token } = await page.evaluate(() => fetch("/api/project", { headers: { "X-Phyllite-Token": new URLSearchParams(location.search).get("token") } }).then((r) => r.json()));
  assert.equal((await fetch(`${new URL(address).origin}/files/open-phyllite.html?token=${file_token}`)).status, 404, "no report can ask for it");
  chmodSync(way, 0o644); // others may have read it
  await stopGui(again.program);
  const third = startGui(folder, new URL(address).port);
  programs.push(third.program);
  assert.notEqual(await third.address, address);
  await close();
});

test("the browser opens by itself, and is not told the token where others could read it", async () => {
  const folder = mkdtempSync(join(above, "rocks-"));
  const tools = join(above, "tools");
  mkdirSync(tools);
  writeFileSync(join(tools, "xdg-open"), `#!/bin/sh\nprintf %s "$*" > ${join(above, "opened.part")} && mv ${join(above, "opened.part")} ${join(above, "opened")}\n`);
  chmodSync(join(tools, "xdg-open"), 0o755);
  const path = process.env.PATH;
  process.env.PATH = tools + delimiter + path;
  const quiet = startGui(folder); // no terminal: nothing is opened
  programs.push(quiet.program);
  await quiet.address;
  const loud = startGui(folder, 0, "--browser");
  programs.push(loud.program);
  process.env.PATH = path;
  await within(10, () => existsSync(join(above, "opened")));
  assert.equal(readFileSync(join(above, "opened"), "utf8"), join(folder, "open-phyllite.html"));
  assert.ok(readFileSync(join(folder, "open-phyllite.html"), "utf8").includes(await loud.address));
});

for (const [width, colorScheme] of [[390, "dark"], [820, "light"], [1920, "dark"]])
  test(`the first screen fits ${width} px, its parts are named, and the focus is seen`, async () => {
    const { page, close } = await open({ viewport: { width, height: 900 }, colorScheme });
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
    for (const name of ["Try one", "Bring your table", "Begin with a measured rock"]) await page.getByRole("region", { name }).waitFor();
    await page.evaluate(() => document.activeElement.blur());
    await assertFocusIsSeen(page, 14);
    await close();
  });
