// Files as the program's Archive writes them (src/lv/heartbeat/archive.cpp): named arrays of numbers with a checksum.
import { writeFileSync } from "node:fs";

function crc32(bytes) {
  let crc = ~0;
  for (const byte of bytes) {
    crc ^= byte;
    for (let bit = 0; bit < 8; ++bit) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return ~crc >>> 0;
}

/** `arrays`: { name: [numbers] }. */
export function writeArchive(file, arrays) {
  const parts = Object.keys(arrays).sort().flatMap((name) => {
    const sizes = Buffer.alloc(16);
    sizes.writeBigUInt64LE(BigInt(name.length), 0);
    sizes.writeBigUInt64LE(BigInt(arrays[name].length), 8);
    return [sizes, Buffer.from(name, "latin1"), Buffer.from(Float64Array.from(arrays[name]).buffer)];
  });
  const body = Buffer.concat(parts);
  const checksum = Buffer.alloc(4);
  checksum.writeUInt32LE(crc32(body));
  writeFileSync(file, Buffer.concat([Buffer.from("ventricle archive 1\n", "latin1"), checksum, body]));
}
