// SPDX-License-Identifier: Apache-2.0
// Foxglove viewers: npm's client reads every channel, the schemas' own validation accepts every
// message, and exported files pass npm's reader with all checks on.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { test } from "node:test";

import { clew, json_lines, require, scratch_directory, serve, ticks_of } from "./view_server.mjs";

const { FoxgloveClient } = require("@foxglove/ws-protocol");
const { WebSocket } = require("ws");
const { parseIDL } = require("@foxglove/omgidl-parser");
const { MessageReader } = require("@foxglove/omgidl-serialization");
const { McapStreamReader } = require("@mcap/core");
const { decompress } = require("fzstd");
const schemas = require("@foxglove/schemas/jsonschema");
const Ajv = require("ajv").default;

const ajv = new Ajv({ strict: false, validateFormats: false });
const validators = new Map();

/// Throws unless the published schema of this name accepts the message.
function validate(name, message) {
  if (!validators.has(name)) validators.set(name, ajv.compile(schemas[name.replace("foxglove.", "")]));
  const valid = validators.get(name);
  assert.ok(valid(message), `${name}: ${ajv.errorsText(valid.errors)}`);
}

/// Subscribes to everything, until the last tick of each topic of ours has come.
function read_all(address, protocol, last_time_ns) {
  const { port, search } = address;
  return new Promise((resolve, reject) => {
    const client = new FoxgloveClient({ ws: new WebSocket(`ws://127.0.0.1:${port}/${search}`, [protocol]) });
    const channels = new Map();
    const messages = new Map();
    client.on("error", reject);
    client.on("advertise", (advertised) => {
      for (const channel of advertised) {
        channels.set(client.subscribe(channel.id), channel);
        messages.set(channel.topic, { channel, received: [] });
      }
    });
    client.on("message", ({ subscriptionId, timestamp, data }) => {
      const { received } = messages.get(channels.get(subscriptionId).topic);
      // What is held begins again with each subscription, and these may come a few at a time.
      if (received.length > 0 && timestamp < received[received.length - 1].timestamp) received.length = 0;
      received.push({ timestamp, bytes: new Uint8Array(data.buffer, data.byteOffset, data.byteLength).slice() });
      const whole = [...messages.values()].filter(({ channel }) => channel.topic !== "/foxglove/log" && channel.topic !== "/foxglove/seen")
        .every(({ received }) => received.length > 0 && received[received.length - 1].timestamp >= last_time_ns);
      if (!whole) return;
      client.close();
      resolve(messages);
    });
  });
}

/// Every message of every channel is what its schema says.
function check(messages) {
  for (const { channel, received } of messages.values()) {
    if (channel.encoding === "json") {
      for (const { bytes } of received) validate(channel.schemaName, JSON.parse(new TextDecoder().decode(bytes)));
      JSON.parse(channel.schema);
    } else {
      const reader = new MessageReader(channel.schemaName, parseIDL(channel.schema));
      for (const { bytes } of received) assert.ok(reader.readMessage(bytes).stamp !== undefined);
    }
  }
}

/// Where the believed robot has been the map of what was seen has no obstacle, and some elsewhere.
function check_seen(file, received) {
  const grid = JSON.parse(new TextDecoder().decode(received[received.length - 1].bytes));
  const cells = new Int8Array(Buffer.from(grid.data, "base64"));
  assert.equal(cells.length % grid.row_stride, 0);
  for (const value of [-1, 0, 100]) assert.ok(cells.includes(value), `no cell is ${value}`);
  for (const { pose_odom_robot: pose } of json_lines(clew("echo", file, "odometry", "--jsonl", "--field", "pose_odom_robot").out)) {
    const column = Math.floor((pose.x_m - grid.pose.position.x) / grid.cell_size.x);
    const row = Math.floor((pose.y_m - grid.pose.position.y) / grid.cell_size.y);
    assert.notEqual(cells[row * grid.row_stride + column * grid.cell_stride], 100, `${pose.x_m} ${pose.y_m}`);
  }
}

test("npm's Foxglove client reads every channel of a recording", async (context) => {
  const file = path.join(scratch_directory(context), "a.mcap");
  assert.equal(clew("run", "krishna_kalra", "--layout", "composed", "--record", file).status, 0);
  const { address } = await serve(context, "view", file);
  const count = ticks_of(file);
  for (const protocol of ["foxglove.sdk.v1", "foxglove.websocket.v1"]) {
    const messages = await read_all(address, protocol, BigInt(count - 1) * 300000000n);
    check(messages);
    assert.equal(messages.size, 14);
    for (const topic of ["/state", "/scan", "/foxglove/scene", "/foxglove/scan", "/foxglove/path", "/foxglove/transforms"]) {
      assert.equal(messages.get(topic).received.length, count, topic);
    }
    assert.ok(messages.get("/foxglove/log").received.length > 0);
    check_seen(file, messages.get("/foxglove/seen").received);
  }
});

test("way-points and their headings are in scenes that the schemas accept", async (context) => {
  const directory = scratch_directory(context);
  const [file, world] = [path.join(directory, "a.mcap"), path.join(directory, "rounds.yaml")];
  writeFileSync(world, "format: clew-world/1\nname: rounds\nbounds: [0, 0, 10, 8]\nstart: [1, 1, 1.57]\n" +
    "waypoints: [[1.2, 6.5], [5, 6.5, ~, 0, 0.6]]\ntarget: [9, 7]\ntarget_heading: 1.57\ntarget_radius: 0.3\n");
  clew("run", "default", "--world", world, "--layout", "composed", "--max-ticks", "80", "--at", "50:goal=9,1", "--record", file);
  const { address } = await serve(context, "view", file);
  const messages = await read_all(address, "foxglove.sdk.v1", BigInt(ticks_of(file) - 1) * 300000000n);
  check(messages);
  const mission_at = (tick) => {
    const { bytes } = messages.get("/foxglove/scene").received.find(({ timestamp }) => timestamp === BigInt(tick) * 300000000n);
    return JSON.parse(new TextDecoder().decode(bytes)).entities.find(({ id }) => id === "run");
  };
  const { cylinders, texts, lines, arrows } = mission_at(10);
  assert.deepEqual(cylinders.slice(0, -1).map(({ pose: { position }, size }) => [position.x, position.y, size.x]), [[1.2, 6.5, 0.6], [5, 6.5, 0.6], [9, 7, 0.6]]);
  assert.deepEqual(texts.map(({ text }) => text), ["1", "2", "3"]);
  assert.equal(lines[0].points.length, 3);
  assert.deepEqual(arrows.map(({ pose: { position, orientation } }) => [position.x, 2 * Math.atan2(orientation.z, orientation.w)].map((value) => Number(value.toFixed(3)))),
    [[5, 0], [9, 1.57]]);
  assert.deepEqual(mission_at(60).cylinders.slice(0, -1).map(({ pose: { position } }) => [position.x, position.y]), [[9, 1]]);
  const target = messages.get("/target");
  const reader = new MessageReader(target.channel.schemaName, parseIDL(target.channel.schema));
  const first = reader.readMessage(target.received[10].bytes);
  assert.deepEqual([first.waypoint, first.waypoints], [1, 3]);
});

test("npm's Foxglove client reads a run under way", async (context) => {
  const { address } = await serve(context, "run", "krishna_kalra", "--pace", "60x", "--view");
  check(await read_all(address, "foxglove.sdk.v1", 100n * 300000000n));
});

test("strangers are refused, and nobody writes", async (context) => {
  const file = path.join(scratch_directory(context), "a.mcap");
  clew("run", "krishna_kalra", "--layout", "composed", "--max-ticks", "20", "--record", file);
  const { port, token } = await serve(context, "view", file);
  const opened = (url, protocols, options) => new Promise((resolve) => {
    const socket = new WebSocket(url, protocols, options);
    socket.on("open", () => resolve(socket));
    socket.on("error", (error) => resolve(String(error)));
  });
  const good = `ws://127.0.0.1:${port}/?token=${token}`;
  assert.match(await opened(`ws://127.0.0.1:${port}/`, ["foxglove.sdk.v1"]), /403/);
  assert.match(await opened(good, ["other.v1"]), /400/);
  assert.match(await opened(good, []), /400/);
  assert.match(await opened(`ws://127.0.0.1:${port}/live?token=${token}`, ["clew.view.v1"]), /400/);
  assert.match(await opened(good, ["foxglove.sdk.v1"], { headers: { Host: "evil.example" } }), /403/);

  const socket = await opened(good, ["foxglove.sdk.v1"], { origin: "https://app.foxglove.dev" });
  const status = new Promise((resolve) => socket.on("message", (data, binary) => {
    const told = binary ? {} : JSON.parse(data);
    if (told.op === "status") resolve(told);
  }));
  socket.send(JSON.stringify({ op: "advertise", channels: [] }));
  assert.match((await status).message, /read only/);
  for (const rubbish of ["", "{", "[]", "null", '{"op":1}', '{"op":"subscribe","subscriptions":7}', '{"op":"subscribe","subscriptions":[{"id":1,"channelId":99}]}', '{"op":"unsubscribe","subscriptionIds":{"a":1}}', "x".repeat(100000)]) socket.send(rubbish);
  socket.send(Buffer.alloc(1000, 255));
  socket.send("y".repeat(1 << 20));  // too large: the connection is closed
  await new Promise((resolve) => socket.on("close", resolve));
  assert.ok(typeof await opened(good, ["foxglove.sdk.v1"]) !== "string");
});

test("an exported file passes npm's reader with every check", (context) => {
  const directory = scratch_directory(context);
  const file = path.join(directory, "a.mcap");
  const exported = path.join(directory, "b.mcap");
  clew("run", "krishna_kalra", "--layout", "composed", "--record", file);
  assert.equal(clew("export", file, "--foxglove", exported).status, 0);
  const reader = new McapStreamReader({ validateCrcs: true, decompressHandlers: { zstd: (data) => decompress(data) } });
  reader.append(readFileSync(exported));
  const channels = new Map();
  const names = new Map();
  const counts = new Map();
  for (let record = reader.nextRecord(); record; record = reader.nextRecord()) {
    if (record.type === "Schema") names.set(record.id, record.name);
    if (record.type === "Channel") channels.set(record.id, record);
    if (record.type !== "Message") continue;
    const { topic, messageEncoding, schemaId } = channels.get(record.channelId);
    counts.set(topic, (counts.get(topic) ?? 0) + 1);
    if (messageEncoding === "json") validate(names.get(schemaId), JSON.parse(new TextDecoder().decode(record.data)));
  }
  assert.ok(reader.done());
  assert.equal(counts.get("/foxglove/scene"), ticks_of(file));
  assert.equal(counts.get("/state"), ticks_of(file));
  // The first, one a second, and the last; a tick takes 0.3 s.
  assert.ok(counts.get("/foxglove/seen") > ticks_of(file) / 5 && counts.get("/foxglove/seen") < ticks_of(file) / 3);
  assert.equal(clew("export", file, "--foxglove", exported).status, 2);
});
