// The page with the program inside (`make browser-lab`): it works from a plain server and from the disk, keeps its files, and asks nobody
// for anything. The one with threads says which server it needs, and computes on them there. Left out where they have not been made.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { availableParallelism, tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { after, before, test } from "node:test";
import { launch, phyllite } from "./pages.mjs";

const made = resolve("build/browser-lab/phyllite.html");
const withThreads = resolve("build/browser-lab/phyllite-threads.html");
const skip = existsSync(made) ? false : "make browser-lab has not been run";
const above = mkdtempSync(join(tmpdir(), "phyllite-inside-"));
const isolating = { "Cross-Origin-Opener-Policy": "same-origin", "Cross-Origin-Embedder-Policy": "require-corp" };
let browser;
const servers = [];

/** The address of a server that has this page alone, and sends these headers with it. */
async function serve(file, headers = {}) {
  const server = createServer((request, response) => (request.url.split("?")[0] === "/" ? response.writeHead(200, { "Content-Type": "text/html", ...headers }).end(readFileSync(file)) : response.writeHead(404).end()));
  servers.push(server);
  await new Promise((listens) => server.listen(0, "127.0.0.1", listens));
  return `http://127.0.0.1:${server.address().port}/`;
}

before(async () => {
  if (skip) return;
  browser = await launch();
});
after(async () => {
  await browser?.close();
  for (const server of servers) server.close();
  rmSync(above, { recursive: true, force: true });
});

/** A browser that has no network once the page is there; `asked` are the requests that left it. */
async function open(at) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, permissions: ["clipboard-read", "clipboard-write"] });
  const page = await context.newPage();
  page.setDefaultTimeout(60000);
  page.asked = [];
  page.trouble = [];
  context.on("request", (r) => r.url().split("?")[0] !== at && !/^(data|blob):/.test(r.url()) && page.asked.push(r.url()));
  page.on("console", (m) => ["error", "warning"].includes(m.type()) && !/GPU stall/.test(m.text()) && page.trouble.push(m.text()));
  page.on("pageerror", (e) => page.trouble.push(String(e)));
  await page.addInitScript(() => {
    window.slow = [];
    new PerformanceObserver((list) => window.slow.push(...list.getEntries().map((e) => Math.round(e.duration)))).observe({ entryTypes: ["longtask"] });
  });
  await page.goto(at);
  await page.getByRole("heading", { name: "Rocks", level: 2 }).waitFor();
  await page.getByText("Files are kept in this browser.").waitFor();
  await context.setOffline(true);
  return { page, context };
}

async function reload(page) {
  await page.context().setOffline(false);
  await page.reload();
  await page.context().setOffline(true);
}

const title = (page, name) => page.getByRole("heading", { name, level: 1, exact: true }).waitFor();
const button = (page, name) => page.getByRole("button", { name, exact: true });
const table = "theta [deg],E [GPa],UCS [MPa]\n0,30,95\n0,31,99\n45,22,52\n45,21,55\n90,17,90\n90,18,86\n";

async function paste(page, text) {
  await page.evaluate((t) => navigator.clipboard.writeText(t), text);
  await page.keyboard.press("Control+V");
}

/** A rock of 1,200 discs from the table. */
async function describe(page) {
  await paste(page, table);
  await title(page, "rock");
  await page.getByText("No problems").waitFor();
  await page.getByLabel("Grain size of the model [mm]").fill("1,66");
  await page.getByLabel("Effort of the search").selectOption("quick");
  await page.getByLabel("Largest number of tests").fill("54");
  await page.evaluate(() => (window.slow = []));
}

/** Recorded, not asserted: other programs of the machine may keep the page from its core. */
const answered = (t, slow) => t.diagnostic(`the page did not answer for ${Math.max(0, ...slow)} ms at most`);

async function readReport(page) {
  const [report] = await Promise.all([page.context().waitForEvent("page"), page.getByRole("link", { name: "Open the report", exact: true }).click()]);
  await report.frameLocator("iframe").getByRole("heading", { level: 1 }).waitFor();
  await report.close();
}

/** The folder in the browser, as its archive has it. */
async function unpacked(page) {
  const [download] = await Promise.all([page.waitForEvent("download"), button(page, "Download all files").click()]);
  const [archive, folder] = [join(above, "all.zip"), mkdtempSync(join(above, "all-"))];
  await download.saveAs(archive);
  execFileSync("python3", ["-m", "zipfile", "-e", archive, folder]);
  return folder;
}

const numbers = (folder) => readdirSync(folder, { recursive: true }).filter((f) => f.endsWith("result.json")).sort().map((f) => JSON.parse(readFileSync(join(folder, f), "utf8")).numbers);

test("a pasted table is checked, calibrated, stopped, gone on with after a reload, tested, taken out; nothing leaves the page", { skip, timeout: 3600000 }, async (t) => {
  const { page, context } = await open(await serve(made));
  await page.getByText("Each command computes on one thread").waitFor();
  await describe(page);
  await button(page, "Save and start calibration").click();
  await page.getByText("Running.", { exact: true }).waitFor();
  await page.getByRole("img", { name: "Specimen in the press" }).waitFor({ timeout: 600000 });
  await button(page, "Stop").click();
  await page.getByText("Stopped; what is finished is kept.").first().waitFor();
  const slow = await page.evaluate(() => window.slow);

  await reload(page);
  await title(page, "rock");
  await page.evaluate(() => (window.slow = []));
  await button(page, "Go on").click();
  await page.getByText("Finished.", { exact: true }).first().waitFor({ timeout: 1800000 });
  slow.push(...(await page.evaluate(() => window.slow)));
  await readReport(page);

  await page.getByLabel("Kind of test").selectOption({ label: "direct tension (DTS)" });
  await page.getByRole("textbox", { name: "Angles" }).fill("0");
  await page.getByLabel("Name of the test").fill("pulled");
  await button(page, "Run the test").click();
  await page.getByRole("article", { name: /pulled/ }).getByText("Finished.").waitFor({ timeout: 600000 });

  const folder = await unpacked(page);
  assert.equal(readFileSync(join(folder, "rock.csv"), "utf8").trim(), table.trim());
  assert.match(readFileSync(join(folder, "rock-calibration/calibration.json"), "utf8"), /"verdict"/);
  execFileSync(phyllite, ["rock", "check", "rock.toml"], { cwd: folder });
  execFileSync(phyllite, ["run", "rock-tests/pulled.toml", "--out", "here"], { cwd: folder });
  assert.deepEqual(numbers(join(folder, "rock-tests/pulled")), numbers(join(folder, "here")), "the installed program says the same");
  assert.deepEqual(page.asked, []);
  assert.deepEqual(page.trouble, []);
  answered(t, slow);
  await context.close();
});

test("on a server that isolates the page a calibration computes on several threads, and says what the installed program says", { skip, timeout: 3600000 }, async (t) => {
  const { page, context } = await open(await serve(withThreads, isolating));
  const threads = Math.min(16, Math.max(2, availableParallelism() - 1));
  await page.getByText(`Each command computes on ${threads} threads.`).waitFor();
  await describe(page);
  const begun = performance.now();
  await button(page, "Save and start calibration").click();
  await page.getByText("Finished.", { exact: true }).first().waitFor({ timeout: 1800000 });
  const took = performance.now() - begun;
  answered(t, await page.evaluate(() => window.slow));
  await readReport(page);

  const folder = await unpacked(page);
  const installed = performance.now();
  const words = ["--threads", String(threads), "calibrate", "rock.toml", "--effort", "quick", "--max-tests", "54", "--out", "here"];
  execFileSync(phyllite, words, { cwd: folder, env: { ...process.env, PHYLLITE_ISA: "sse2" } });
  t.diagnostic(`${Math.round(took / 1000)} s; the installed program on as many threads, with SSE2, ${Math.round((performance.now() - installed) / 1000)} s`);
  execFileSync("python3", [resolve("tools/compare_calibrations.py"), join(folder, "rock-calibration"), join(folder, "here")]);
  assert.deepEqual(page.asked, []);
  assert.deepEqual(page.trouble, []);
  await context.close();
});

test("where no header isolates the page with threads, it says which are needed, and which page needs none", { skip, timeout: 60000 }, async () => {
  const page = await browser.newPage();
  for (const at of [await serve(withThreads), `file://${withThreads}`]) {
    await page.goto(at);
    await page.getByText(/server sends Cross-Origin-Opener-Policy: same-origin and Cross-Origin-Embedder-Policy: require-corp.*Open phyllite\.html/).waitFor();
  }
  await page.close();
});

test("the file opens from the disk and keeps what it is given; a folder is taken over", { skip, timeout: 600000 }, async () => {
  const { page, context } = await open(`file://${made}`);
  const folder = mkdtempSync(join(above, "rocks-"));
  writeFileSync(join(folder, "slate.csv"), table);
  writeFileSync(join(folder, "slate.toml"), `name = "slate"\ndata = "slate.csv"\n`);
  await page.getByLabel("Folder to open").setInputFiles(folder);
  await page.getByRole("button", { name: /^slate/ }).first().click();
  await title(page, "slate");
  await page.getByText("No problems").waitFor();
  await reload(page);
  await title(page, "slate");
  assert.equal(readFileSync(join(await unpacked(page), "slate.csv"), "utf8"), table);
  await button(page, "Start calibration").click(); // in a worker of a worker
  await page.getByText("Running.", { exact: true }).waitFor();
  assert.deepEqual(page.asked, []);
  assert.deepEqual(page.trouble, []);
  await context.close();
});
