// The data inside report.html, read without its script (validation/report/payload.h).
import { readFileSync } from 'node:fs';
import { inflateSync } from 'node:zlib';

export function dataOf(file) {
  const text = readFileSync(file, 'utf8').match(/id="data">([^<]*)</)[1];
  const bytes = inflateSync(Buffer.from(text, 'base64'));
  const length = bytes.readUInt32LE(0), begin = 4 + length;
  const head = JSON.parse(bytes.subarray(4, begin));
  return { model: head.model, part: (name) => bytes.subarray(begin + head.parts[name][0], begin + head.parts[name][0] + head.parts[name][1]) };
}

export function csvOf(file) {
  const [heading, ...lines] = readFileSync(file, 'utf8').trim().split('\n');
  const names = heading.split(',');
  return lines.map((line) => Object.fromEntries(line.split(',').map((cell, i) => [names[i], cell])));
}
