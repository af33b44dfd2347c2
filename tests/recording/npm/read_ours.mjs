// SPDX-License-Identifier: Apache-2.0
// Reads recordings of ours with the packages that others use, by the index and as a stream, every CRC
// checked, and compares each decoded field with what was recorded.
//   node read_ours.mjs INTEROP_PROGRAM DIRECTORY

import { parseIDL } from "@foxglove/omgidl-parser";
import { MessageReader } from "@foxglove/omgidl-serialization";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { FileHandleReadable } from "@mcap/nodejs";
import { loadDecompressHandlers } from "@mcap/support";
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { open, readFile } from "node:fs/promises";
import { join } from "node:path";

import { plain } from "./plain_values.mjs";

const [program, directory] = process.argv.slice(2);
const decompressHandlers = await loadDecompressHandlers();

/** Collects records of any origin in the form in which the program prints what it wrote. */
class Collection {
  constructor() {
    this.decoders = new Map();
    this.schemas = new Map();
    this.channels = new Map();
    this.content = { attachments: {}, metadata: {}, samples: [] };
  }
  schema(schema) {
    assert.equal(schema.encoding, "omgidl");
    this.schemas.set(schema.id, schema);
  }
  channel(channel) {
    assert.equal(channel.messageEncoding, "cdr");
    this.channels.set(channel.id, channel);
    const schema = this.schemas.get(channel.schemaId);
    const definitions = parseIDL(new TextDecoder().decode(schema.data));
    this.decoders.set(channel.id, new MessageReader(schema.name, definitions));
  }
  message(message) {
    this.content.samples.push({
      topic: this.channels.get(message.channelId).topic,
      sequence: message.sequence,
      log_time_ns: message.logTime.toString(),
      publish_time_ns: message.publishTime.toString(),
      fields: plain(this.decoders.get(message.channelId).readMessage(message.data)),
    });
  }
  attachment(attachment) {
    assert.equal(attachment.mediaType, "application/yaml");
    this.content.attachments[attachment.name] = new TextDecoder().decode(attachment.data);
  }
  metadata(metadata) {
    this.content.metadata[metadata.name] = plain(metadata.metadata);
  }
}

async function readByIndex(file) {
  const handle = await open(file);
  const readable = new FileHandleReadable(handle);
  const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
  const collection = new Collection();
  for (const schema of reader.schemasById.values()) collection.schema(schema);
  for (const channel of reader.channelsById.values()) collection.channel(channel);
  for await (const attachment of reader.readAttachments({ validateCrcs: true })) {
    collection.attachment(attachment);
  }
  for await (const metadata of reader.readMetadata()) collection.metadata(metadata);
  for await (const message of reader.readMessages({ validateCrcs: true })) {
    collection.message(message);
  }
  await handle.close();
  assert.equal(reader.statistics.messageCount, BigInt(collection.content.samples.length));
  assert.equal(reader.statistics.chunkCount, reader.chunkIndexes.length);
  return { content: collection.content, chunkIndexes: reader.chunkIndexes };
}

async function readAsStream(file) {
  const reader = new McapStreamReader({ validateCrcs: true, decompressHandlers });
  const collection = new Collection();
  reader.append(await readFile(file));
  for (let record; (record = reader.nextRecord()); ) {
    if (record.type === "Schema") collection.schema(record);
    if (record.type === "Channel") collection.channel(record);
    if (record.type === "Message") collection.message(record);
    if (record.type === "Attachment") collection.attachment(record);
    if (record.type === "Metadata") collection.metadata(record);
  }
  assert.ok(reader.done());
  return collection.content;
}

for (const compression of ["", "zstd", "lz4"]) {
  const file = join(directory, `ours-${compression || "none"}.mcap`);
  const written = JSON.parse(
    execFileSync(program, ["write", file, compression], { maxBuffer: 1 << 28 }),
  );
  assert.ok(written.samples.length > 500);

  const { content, chunkIndexes } = await readByIndex(file);
  assert.deepStrictEqual(content, written);
  assert.ok(chunkIndexes.length > 5);
  // A chunk that does not shrink is stored as it is; most do.
  assert.ok(chunkIndexes.some((index) => index.compression === compression));
  assert.deepStrictEqual(await readAsStream(file), written);
  console.log(`${file}: ${written.samples.length} samples, each field as it was written`);
}
