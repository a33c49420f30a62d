// The page with the program inside (`make browser-lab`): it works from a plain server and from the disk, keeps its files, and asks nobody
// for anything. Left out where it has not been made.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { after, before, test } from "node:test";
import { launch, phyllite } from "./pages.mjs";

const made = resolve("build/browser-lab/index.html");
const skip = existsSync(made) ? false : "make browser-lab has not been run";
const above = mkdtempSync(join(tmpdir(), "phyllite-inside-"));
const longest = 100; // of what keeps the page from answering [ms]
let browser, server, address;

before(async () => {
  if (skip) return;
  browser = await launch();
  server = createServer((request, response) => (request.url === "/" ? response.writeHead(200, { "Content-Type": "text/html" }).end(readFileSync(made)) : response.writeHead(404).end()));
  await new Promise((listens) => server.listen(0, "127.0.0.1", listens));
  address = `http://127.0.0.1:${server.address().port}/`;
});
after(async () => {
  await browser?.close();
  server?.close();
  rmSync(above, { recursive: true, force: true });
});

/** A browser without a network, once the page is there; `asked` are the requests that left it. */
async function open(at) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, permissions: at.startsWith("http") ? ["clipboard-read", "clipboard-write"] : [] });
  const page = await context.newPage();
  page.setDefaultTimeout(60000);
  page.asked = [];
  page.trouble = [];
  context.on("request", (r) => r.url() !== at && !/^(data|blob):/.test(r.url()) && page.asked.push(r.url()));
  page.on("console", (m) => ["error", "warning"].includes(m.type()) && !/GPU stall/.test(m.text()) && page.trouble.push(m.text()));
  page.on("pageerror", (e) => page.trouble.push(String(e)));
  await page.addInitScript(() => {
    window.slow = [];
    new PerformanceObserver((list) => window.slow.push(...list.getEntries().map((e) => Math.round(e.duration)))).observe({ entryTypes: ["longtask"] });
  });
  await page.goto(at);
  await page.getByRole("heading", { name: "Rocks", level: 2 }).waitFor();
  return { page, context };
}

const title = (page, name) => page.getByRole("heading", { name, level: 1, exact: true }).waitFor();
const table = "theta [deg],E [GPa],UCS [MPa]\n0,30,95\n0,31,99\n45,22,52\n45,21,55\n90,17,90\n90,18,86\n";

async function pasteRock(page) {
  await page.getByLabel("Choose a file").setInputFiles({ name: "slate.csv", mimeType: "text/csv", buffer: Buffer.from(table) });
  await title(page, "slate");
  await page.getByText("No problems").waitFor();
}

test("a table is checked, calibrated, stopped, tested again after a reload; nothing leaves the page", { skip, timeout: 1800000 }, async () => {
  const { page, context } = await open(address);
  await page.getByText("Files are kept in this browser.").waitFor();
  await pasteRock(page);
  await page.getByRole("button", { name: /^Save/ }).first().click();
  await page.evaluate(() => (window.slow = []));
  await page.getByRole("button", { name: "Calibrate", exact: true }).click();
  await page.getByRole("img", { name: "Specimen in the press" }).waitFor({ timeout: 240000 });
  await page.getByRole("button", { name: "Stop", exact: true }).click();
  await page.getByText("Stopped; what is finished is kept.").first().waitFor();
  assert.ok(Math.max(0, ...(await page.evaluate(() => window.slow))) <= longest, String(await page.evaluate(() => window.slow)));

  await page.reload();
  await title(page, "slate");
  await page.getByText("Stopped; what is finished is kept.").first().waitFor();
  assert.deepEqual(page.asked, []);
  assert.deepEqual(page.trouble, []);

  const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "Download all files" }).click()]);
  const archive = join(above, "all.zip");
  await download.saveAs(archive);
  execFileSync("python3", ["-m", "zipfile", "-e", archive, join(above, "all")]);
  assert.equal(readFileSync(join(above, "all/slate.csv"), "utf8"), table);
  execFileSync(phyllite, ["rock", "check", join(above, "all/slate.toml")]);
  await context.close();
});

test("the file opens from the disk", { skip, timeout: 300000 }, async () => {
  const { page, context } = await open(`file://${made}`);
  await pasteRock(page);
  await page.reload();
  await title(page, "slate");
  assert.deepEqual(page.asked, []);
  assert.deepEqual(page.trouble, []);
  await context.close();
});
