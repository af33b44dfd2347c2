// SPDX-License-Identifier: Apache-2.0
// Writes files with the packages that others use, with every optional part present and absent and in
// every compression, and compares what our reader finds in them with what was written.
//   node write_theirs.mjs INTEROP_PROGRAM DIRECTORY

import zstd from "@foxglove/wasm-zstd";
import { McapRecordBuilder, McapWriter, TempBuffer } from "@mcap/core";
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { writeFileSync } from "node:fs";
import { join } from "node:path";

import { hex } from "./plain_values.mjs";

const [program, directory] = process.argv.slice(2);
await zstd.isLoaded;

/** Optional parts of a file, as McapWriter names them. */
const OPTIONS = [
  "useStatistics",
  "useSummaryOffsets",
  "repeatSchemas",
  "repeatChannels",
  "useAttachmentIndex",
  "useMetadataIndex",
  "useMessageIndex",
  "useChunkIndex",
];

/** No package has an lz4 compressor: that of the lz4 command. The same chunk comes many times. */
const lz4Frames = new Map();
function lz4(bytes) {
  const key = hex(bytes);
  if (!lz4Frames.has(key)) lz4Frames.set(key, execFileSync("lz4", ["-c"], { input: bytes }));
  return lz4Frames.get(key);
}

const PACKINGS = {
  unchunked: { useChunks: false },
  uncompressed: {},
  zstd: {
    compressChunk: (bytes) => ({ compression: "zstd", compressedData: zstd.compress(bytes) }),
  },
  lz4: { compressChunk: (bytes) => ({ compression: "lz4", compressedData: lz4(bytes) }) },
};

const SCHEMA = { name: "a::T", encoding: "omgidl", data: Buffer.from("struct T { long x; };") };
const CHANNELS = [
  { schemaId: 1, topic: "/a", messageEncoding: "cdr", metadata: new Map([["key", "value"]]) },
  { schemaId: 0, topic: "/b", messageEncoding: "", metadata: new Map() },
];
/** Times that go back within a chunk and from one chunk to the next, and come twice. */
const TIMES = [0, 2, 1, 3, 3, 5, 4, 7, 8, 9, 6, 3];
const MESSAGES = TIMES.map((time, i) => ({
  channelId: i % 2,
  sequence: i,
  logTime: BigInt(time) * 1_000_000_000_000n,
  publishTime: BigInt(100 + i),
  data: Buffer.from(`message ${i} `.repeat(20)),
}));
const ATTACHMENTS = [
  { name: "one", logTime: 1n, createTime: 2n, mediaType: "text/plain", data: Buffer.from("1") },
  { name: "empty", logTime: 3n, createTime: 4n, mediaType: "", data: Buffer.alloc(0) },
];
const METADATA = { name: "facts", metadata: new Map([["seed", "1"]]) };

async function write(file, options) {
  const buffer = new TempBuffer();
  const writer = new McapWriter({ writable: buffer, chunkSize: 700, ...options });
  await writer.start({ profile: "p", library: "l" });
  await writer.addAttachment(ATTACHMENTS[0]);
  assert.equal(await writer.registerSchema(SCHEMA), 1);
  for (const channel of CHANNELS) await writer.registerChannel(channel);
  for (const message of MESSAGES) await writer.addMessage(message);
  await writer.addMetadata(METADATA);
  await writer.addAttachment(ATTACHMENTS[1]);
  await writer.end();
  writeFileSync(file, buffer.get());
}

/** A file whose records are all longer than this version knows, as a later version may write. */
function writePadded(file) {
  const builder = new McapRecordBuilder({ padRecords: true });
  builder.writeMagic();
  builder.writeHeader({ profile: "p", library: "l" });
  builder.writeAttachment(ATTACHMENTS[0]);
  builder.writeSchema({ id: 1, ...SCHEMA });
  CHANNELS.forEach((channel, id) => builder.writeChannel({ id, ...channel }));
  for (const message of MESSAGES) builder.writeMessage(message);
  builder.writeMetadata(METADATA);
  builder.writeAttachment(ATTACHMENTS[1]);
  builder.writeDataEnd({ dataSectionCrc: 0 });
  builder.writeFooter({ summaryStart: 0n, summaryOffsetStart: 0n, summaryCrc: 0 });
  builder.writeMagic();
  writeFileSync(file, builder.buffer);
}

function expectedMessage(message) {
  return {
    topic: CHANNELS[message.channelId].topic,
    sequence: message.sequence,
    log_time_ns: message.logTime.toString(),
    publish_time_ns: message.publishTime.toString(),
    data: hex(message.data),
  };
}

const expected = {
  header: { profile: "p", library: "l" },
  tear: null,
  schemas: [{ id: 1, name: "a::T", encoding: "omgidl", data: SCHEMA.data.toString() }],
  channels: CHANNELS.map((channel, id) => ({
    id,
    schema_id: channel.schemaId,
    topic: channel.topic,
    message_encoding: channel.messageEncoding,
    metadata: Object.fromEntries(channel.metadata),
  })),
  in_file_order: MESSAGES.map(expectedMessage),
  // Sorting is stable: equal times stay in the order of the file.
  by_time: [...MESSAGES]
    .sort((a, b) => Number(a.logTime - b.logTime))
    .map(expectedMessage),
  attachments: ATTACHMENTS.map((attachment) => ({
    name: attachment.name,
    media_type: attachment.mediaType,
    log_time_ns: attachment.logTime.toString(),
    create_time_ns: attachment.createTime.toString(),
    data: hex(attachment.data),
  })),
  metadata: [{ name: "facts", entries: { seed: "1" } }],
};

const files = [];
for (const [packing, packingOptions] of Object.entries(PACKINGS)) {
  for (let choice = 0; choice < 1 << OPTIONS.length; ++choice) {
    const parts = Object.fromEntries(OPTIONS.map((name, i) => [name, (choice & (1 << i)) !== 0]));
    const file = join(directory, `theirs-${packing}-${choice}.mcap`);
    await write(file, { ...packingOptions, ...parts });
    files.push(file);
  }
}
files.push(join(directory, "theirs-padded.mcap"));
writePadded(files.at(-1));

const answers = execFileSync(program, ["read"], { input: files.join("\n"), maxBuffer: 1 << 28 });
const lines = answers.toString().trimEnd().split("\n");
assert.equal(lines.length, files.length);
let indexed = 0;
lines.forEach((line, i) => {
  const { indexed: byIndex, ...found } = JSON.parse(line);
  assert.deepStrictEqual(found, expected, files[i]);
  if (byIndex) ++indexed;
});
// Those with statistics, repeated schemas and channels, and all three indexes, in chunks: the other
// two options are free.
assert.equal(indexed, 3 * 4);
console.log(`${files.length} files read as they were written, ${indexed} of them by their index`);
