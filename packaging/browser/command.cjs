// The program of the browser as a command of node, in the folder it is called from: node command.cjs BUILD WORDS...
// Without `--threads 1` on all cores.
const { readFileSync } = require("node:fs");
const [build, ...words] = process.argv.slice(2);
const asked = Number(words[words.indexOf("--threads") + 1]) || require("node:os").availableParallelism();
const name = require("node:path").resolve(build, asked > 1 ? "phyllite_threads" : "phyllite");
const phyllite = require(`${name}.js`);
const wasm = new WebAssembly.Module(readFileSync(`${name}.wasm`));
const here = process.cwd();

phyllite({
  noInitialRun: true,
  number: process.pid,
  threads: asked,
  begins: asked > 1,
  instantiateWasm: (imports, done) => (WebAssembly.instantiate(wasm, imports).then((instance) => done(instance, wasm)), {}),
  print: console.log,
  printErr: console.error,
  onExit: (code) => (process.exitCode = code),
}).then((program) => {
  program.FS.mkdirTree(here);
  program.FS.mount(program.NODEFS, { root: here }, here);
  program.FS.chdir(here);
  program.callMain(words);
});
