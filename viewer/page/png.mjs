// Writes a PNG file of at most 256 colours: each is three numbers, and each pixel the place of its colour.

import { deflateSync } from 'node:zlib';

function crc(bytes) {
  let value = 0xffffffff;
  for (const byte of bytes) {
    value ^= byte;
    for (let bit = 0; bit < 8; ++bit) value = (value >>> 1) ^ (value & 1 ? 0xedb88320 : 0);
  }
  return ~value >>> 0;
}

function number(value) {
  const bytes = Buffer.alloc(4);
  bytes.writeUInt32BE(value);
  return bytes;
}

function chunk(kind, data) {
  const named = Buffer.concat([Buffer.from(kind), data]);
  return Buffer.concat([number(data.length), named, number(crc(named))]);
}

export function indexedPng({ width, height, palette, pixels }) {
  const rows = Buffer.alloc((width + 1) * height); // each after the byte 0: without a filter
  for (let y = 0; y < height; ++y) rows.set(pixels.slice(width * y, width * (y + 1)), (width + 1) * y + 1);
  const depthAndKind = [8, 3, 0, 0, 0];
  return Buffer.concat([
    Buffer.from('\x89PNG\r\n\x1a\n', 'latin1'),
    chunk('IHDR', Buffer.from([...number(width), ...number(height), ...depthAndKind])),
    chunk('PLTE', Buffer.from(palette.flat())),
    chunk('IDAT', deflateSync(rows, { level: 9 })),
    chunk('IEND', Buffer.alloc(0)),
  ]);
}
