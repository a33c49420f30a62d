// The program of the browser as a command of node, in the folder it is called from: node command.cjs BUILD WORDS...
const { readFileSync } = require("node:fs");
const [build, ...words] = process.argv.slice(2);
const phyllite = require(require("node:path").resolve(build, "phyllite.js"));
const wasm = new WebAssembly.Module(readFileSync(`${build}/phyllite.wasm`));
const here = process.cwd();

phyllite({
  noInitialRun: true,
  number: process.pid,
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
