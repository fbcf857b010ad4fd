// Runs a module built from this crate and prints what it prints. usage: node run.mjs MODULE
import { readFile } from 'node:fs/promises';

let text = '';
const env = { print: (character) => { text += String.fromCodePoint(character); } };
const { instance } = await WebAssembly.instantiate(await readFile(process.argv[2]), { env });
instance.exports.bits();
process.stdout.write(text);
