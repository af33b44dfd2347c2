// SPDX-License-Identifier: Apache-2.0
// Reads a bag with npm's reader of MCAP, every CRC checked, and decodes all messages with the
// official definitions: a JSON object a message, after one for the file.
//   node read_bag.mjs FILE.mcap
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import { McapStreamReader } from "@mcap/core";
import { loadDecompressHandlers } from "@mcap/support";
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";

import { hashOf, readerOf } from "./official_types.mjs";

const reader = new McapStreamReader({
  validateCrcs: true,
  decompressHandlers: await loadDecompressHandlers(),
});
reader.append(await readFile(process.argv[2]));
const schemas = new Map();
const channels = new Map();
const head = { topics: {}, counts: {} };
const messages = [];
const plain = (key, value) => {
  if (typeof value === "number" && !Number.isFinite(value)) return String(value);
  if (typeof value === "bigint") return Number(value);
  return ArrayBuffer.isView(value) ? Array.from(value, (item) => plain("", item)) : value;
};
for (let record; (record = reader.nextRecord()); ) {
  if (record.type === "Header") head.profile = record.profile;
  if (record.type === "Metadata") head[record.name] = Object.fromEntries(record.metadata);
  if (record.type === "Schema") {
    assert.equal(record.encoding, "ros2msg");
    schemas.set(record.id, record);
  }
  if (record.type === "Channel" && !channels.has(record.id)) {
    const { name, data } = schemas.get(record.schemaId);
    assert.equal(record.messageEncoding, "cdr");
    assert.equal(record.metadata.get("topic_type_hash"), hashOf(name));
    const own = new MessageReader(parse(new TextDecoder().decode(data), { ros2: true }));
    channels.set(record.id, { topic: record.topic, official: readerOf(name), own });
    head.topics[record.topic] = {
      type: name,
      qos: record.metadata.get("offered_qos_profiles"),
    };
  }
  if (record.type === "Message") {
    const { topic, official, own } = channels.get(record.channelId);
    const message = official.readMessage(record.data);
    // The definition in the bag reads the same as the official one.
    assert.deepEqual(own.readMessage(record.data), message);
    head.counts[topic] = (head.counts[topic] ?? 0) + 1;
    messages.push({ topic, time_ns: Number(record.logTime), message });
  }
}
assert.ok(reader.done());
console.log(JSON.stringify(head));
for (const message of messages) console.log(JSON.stringify(message, plain));
