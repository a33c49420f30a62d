// What the tests of both pages have in common: the program, the browser, waiting, and the focus that is seen.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { resolve } from "node:path";
import { chromium } from "../../web/node_modules/playwright-core/index.mjs";

export const phyllite = resolve(process.env.PHYLLITE ?? "build/release/phyllite"); // also from other folders

export const launch = (...more) => chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox", "--disable-dev-shm-usage", ...more] });

/** For a page that has not been opened: the gui shows commands and TOML. A report in its sandbox keeps nothing. */
export const showCommands = () => {
  if (origin !== "null") localStorage.setItem("phyllite commands", "true");
};

export const within = async (seconds, holds) => {
  for (const end = Date.now() + 1000 * seconds; Date.now() < end; ) {
    if (await holds()) return;
    await new Promise((next) => setTimeout(next, 50));
  }
  assert.ok(await holds(), String(holds));
};

/** Starts `phyllite gui`; the address comes as soon as the program prints it. */
export function startGui(folder, port = 0, ...more) {
  const program = spawn(phyllite, ["--threads", "2", "gui", folder, "--port", String(port), ...more], { stdio: ["ignore", "pipe", "inherit"] });
  const address = new Promise((resolve, reject) => {
    let said = "";
    program.stdout.on("data", (bytes) => {
      said += bytes;
      const found = said.match(/http:\/\/127\.0\.0\.1:\d+\/\?token=\w+/);
      if (found) resolve(found[0]);
    });
    program.on("exit", (code) => reject(new Error(`ended with ${code}: ${said}`)));
  });
  return { program, address };
}

export async function stopGui(program) {
  program?.removeAllListeners("exit");
  program?.kill("SIGINT");
  await new Promise((gone) => (program && program.exitCode === null ? program.on("exit", gone) : gone()));
}

/** Goes on by the keyboard alone. */
export async function assertFocusIsSeen(page, steps) {
  const unseen = new Set();
  for (let i = 0; i < steps; ++i) {
    await page.keyboard.press("Tab");
    const found = await page.evaluate(() => {
      const e = document.activeElement;
      const style = getComputedStyle(e);
      return e === document.body || (style.outlineStyle !== "none" && parseFloat(style.outlineWidth) >= 2) ? "" : e.outerHTML.slice(0, 120);
    });
    if (found) unseen.add(found);
  }
  assert.deepEqual([...unseen], []);
}
