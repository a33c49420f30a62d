// Bundles src/ into report.html and gui.html, files without references: `phyllite` carries them. Into the report it puts the data.
import { build } from "esbuild";
import { readFile, writeFile } from "node:fs/promises";

const options = { bundle: true, minify: true, write: false, target: "es2022", legalComments: "none", charset: "utf8" };
const licences = (await readFile("LICENCES", "utf8")).trim();

async function bundle(script, style, page, out) {
  const [code, looks] = await Promise.all([build({ ...options, entryPoints: [script], format: "iife" }), build({ ...options, entryPoints: [style] })]);
  const text = code.outputFiles[0].text.replaceAll("</script", "<\\/script").replaceAll("<!--", "<\\!--");
  const filled = (await readFile(page, "utf8"))
    .replace("<head>", `<head>\n<!-- ${licences} -->`)
    .replace("/*style*/", () => looks.outputFiles[0].text.trim())
    .replace("/*script*/", () => text.trim());
  await writeFile(out, filled);
}

await bundle("src/main.ts", "src/style.css", "src/page.html", "report.html");
await bundle("src/gui/gui.ts", "src/gui/gui.css", "src/gui/page.html", "gui.html");
