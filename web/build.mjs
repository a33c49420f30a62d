// Bundles src/ into report.html, one file without references: `phyllite` carries it and puts the data in.
import { build } from "esbuild";
import { readFile, writeFile } from "node:fs/promises";

const options = { bundle: true, minify: true, write: false, target: "es2022", legalComments: "none", charset: "utf8" };
const script = await build({ ...options, entryPoints: ["src/main.ts"], format: "iife" });
const style = await build({ ...options, entryPoints: ["src/style.css"] });
const page = await readFile("src/page.html", "utf8");
const licences = (await readFile("LICENCES", "utf8")).trim();
const text = script.outputFiles[0].text.replaceAll("</script", "<\\/script").replaceAll("<!--", "<\\!--");
await writeFile(
  "report.html",
  page
    .replace("<head>", `<head>\n<!-- ${licences} -->`)
    .replace("/*style*/", () => style.outputFiles[0].text.trim())
    .replace("/*script*/", () => text.trim()),
);
