// SPDX-License-Identifier: Apache-2.0
// Recordings whose contents are anything: the page's reader leaves out what it cannot read, and says
// so. Without a browser.
import assert from "node:assert/strict";
import { createRequire } from "node:module";
import path from "node:path";
import { test } from "node:test";

const directory = process.env.CLEW_PAGE_DIR;
const require = createRequire(path.join(directory, "package.json"));
const { build } = require("esbuild");
const { McapWriter } = require("@mcap/core");
const made = await build({
  stdin: { contents: 'export { McapFeed, Recording, tell_complaints_to } from "./recording"; export { Run } from "./run"; export { read_world } from "./world"; export { Schema } from "./cdr_fields";', resolveDir: path.join(directory, "src") },
  bundle: true, write: false, format: "esm",
});
const { McapFeed, Recording, tell_complaints_to, Run, Schema, read_world } = await import(`data:text/javascript;base64,${Buffer.from(made.outputFiles[0].contents).toString("base64")}`);

const kState = `module clew { module msg {
struct Pose { double x_m; double y_m; double heading_rad; };
struct State { Pose pose_world_robot; };
}; };`;
const kEvents = `module clew { module msg {
struct Entry { string text; };
struct Event { Entry first; sequence<Entry> entries; };
}; };`;
const bytes = (text) => new TextEncoder().encode(text);

/// A sample of State: a head, and three numbers.
function state(x, y) {
  const sample = new DataView(new ArrayBuffer(28));
  sample.setUint8(1, 1);
  [x, y, 0].forEach((value, i) => sample.setFloat64(4 + 8 * i, value, true));
  return new Uint8Array(sample.buffer);
}

/// A file with these channels (topic, schema, IDL), messages (channel, tick, bytes) and texts.
async function file_of({ channels, messages, texts = {} }) {
  const pieces = [];
  const writer = new McapWriter({
    writable: { position: () => BigInt(pieces.reduce((sum, each) => sum + each.length, 0)), write: async (piece) => { pieces.push(piece.slice()); } },
    useChunks: false,
  });
  await writer.start({ profile: "", library: "test" });
  await writer.addMetadata({ name: "clew", metadata: new Map([["tick_s", "0.1"], ["seed", "1"]]) });
  for (const [name, text] of Object.entries(texts)) {
    await writer.addAttachment({ name, mediaType: "application/yaml", data: bytes(text), logTime: 0n, createTime: 0n });
  }
  const ids = [];
  for (const [topic, name, idl] of channels) {
    const schemaId = idl === undefined ? 0 : await writer.registerSchema({ name, encoding: "omgidl", data: bytes(idl) });
    ids.push(await writer.registerChannel({ schemaId, topic, messageEncoding: idl === undefined ? "json" : "cdr", metadata: new Map() }));
  }
  for (const [channel, tick, data] of messages) {
    const time = BigInt(tick) * 100000000n;
    await writer.addMessage({ channelId: ids[channel], sequence: tick, logTime: time, publishTime: time, data });
  }
  await writer.end();
  return Buffer.concat(pieces);
}

async function read(contents) {
  const recording = new Recording("hostile");
  new McapFeed(recording).append(await file_of(contents));
  return recording;
}

test("a side channel that is no JSON is left out, and told", async () => {
  const recording = await read({
    channels: [["clew/interventions"], ["clew/incidents"], ["/state", "clew::msg::State", kState]],
    messages: [[0, 3, bytes("{")], [1, 4, bytes("\xff\x00")], [0, 5, bytes("null")], [0, 6, bytes('{"changes": 7, "order": {}}')],
      [1, 7, bytes("[1]")], [0, 8, bytes('{"changes": ["goal=1"], "order": ""}')], [2, 9, state(1, 2)]],
    texts: { "graph.yaml": "drive: {}\n", "world.yaml": "bounds: [0, 0, 9, 9]\nstart: [1, 1, 0]\ntarget: [8, 8]\n" },
  });
  // The first of each channel.
  assert.deepEqual(recording.complaints, ["clew/interventions at tick 3 is no JSON: what it says is left out",
    "clew/incidents at tick 4 is no JSON: what it says is left out"]);
  assert.deepEqual(recording.changes.map(({ tick, changes, order }) => [tick, changes, order]), [[5, [], ""], [6, [], ""], [8, ["goal=1"], ""]]);
  assert.equal(recording.incidents.length, 1);
  const run = new Run(recording, 0);
  assert.equal(run.follow(1000), false);
  assert.deepEqual(run.truth, [{ x: 1, y: 2, heading: 0 }]);
});

test("schemas and samples that cannot be read are left out, and told", async () => {
  const recording = await read({
    channels: [["/odometry", "clew::msg::Odometry", "struct {"], ["/event", "clew::msg::Event", kEvents], ["/state", "clew::msg::State", kState]],
    messages: [[0, 0, bytes("any")], [1, 0, new Uint8Array(64).fill(255)], [2, 0, state(1, 2)], [2, 1, new Uint8Array(3)]],
    texts: { "graph.yaml": "- 1\n- 2\n", "world.yaml": "a: [", "robot.yaml": "7" },
  });
  assert.equal(recording.complaints.length, 1);
  assert.match(recording.complaints[0], /^the schema of topic 'odometry' cannot be read \(.+\): the topic is left out$/);
  const run = new Run(recording, 0);
  assert.equal(run.follow(1000), false);
  assert.deepEqual(run.ticks, [0, 1]);
  assert.equal(run.world, undefined);
  assert.deepEqual(run.graph, {});
  assert.equal(run.radius_m, 0.15);
  assert.equal(recording.topic("event").message(0), undefined);
  // The texts, the event, and the sample of the state behind the first one: the first of each kind.
  const [, graph, world, robot, event, sample, ...rest] = recording.complaints;
  assert.equal(graph, "graph.yaml cannot be read (no names with values): it is left out");
  assert.match(world, /^world\.yaml cannot be read \(.+\): it is left out$/);
  assert.equal(robot, "robot.yaml cannot be read (no names with values): it is left out");
  assert.equal(event, "topic 'event' at tick 0 is no message of its type: it is left out");
  assert.equal(sample, "topic 'state' at tick 1 is no message of its type: it is left out");
  assert.deepEqual(rest, []);
});

test("a tick that cannot be read is told, and those behind it are read", async () => {
  const idl = "module clew { module msg { struct Event { double a; double b; double c; double d; double entries; }; }; };";
  const recording = await read({
    channels: [["/event", "clew::msg::Event", idl], ["/state", "clew::msg::State", kState]],
    // No list of events, but a number: 44 bytes with it.
    messages: [0, 1, 2, 3].flatMap((tick) => [[1, tick, state(tick, 2)], ...tick === 1 ? [[0, tick, Uint8Array.from({ length: 44 }, (_, i) => i === 1 ? 1 : 0)]] : []]),
    texts: { "graph.yaml": "drive: {}\n", "world.yaml": "bounds: [0, 0, 9, 9]\nstart: [1, 1, 0]\ntarget: [8, 8]\n", "robot.yaml": "radius_m: 0.2\n" },
  });
  const run = new Run(recording, 0);
  assert.equal(run.follow(1000), false);
  assert.deepEqual(run.ticks, [0, 1, 2, 3]);
  assert.deepEqual(run.truth.map(({ x }) => x), [0, 1, 2, 3]);
  assert.equal(run.belief.length, 4);
  assert.equal(recording.complaints.length, 1);
  assert.match(recording.complaints[0], /^tick 1 cannot be read whole \(.*iterable.*\): what cannot is left out$/);
});

test("somebody hears of each new complaint, and they have an end", () => {
  let heard = 0;
  tell_complaints_to(() => heard++);
  const recording = new Recording("full");
  recording.complain("a", "first");
  recording.complain("a", "second");
  for (let i = 0; i < 100; i++) recording.complain(`kind ${i}`, "more");
  tell_complaints_to(() => undefined);
  assert.equal(recording.complaints[0], "first");
  assert.equal(recording.complaints.length, 12);
  assert.equal(heard, 12);
});

test("the first list of a sample is read without the rest, as with it", () => {
  for (const [members, begin] of [["double a; uint32 b;", 4 + 16 + 0], ["uint32 b;", 4 + 8], ["double a; double c;", 4 + 16 + 8]]) {
    const schema = new Schema("m::List", `module m { struct List { ${members} sequence<double> values; string text; }; };`);
    const sample = new DataView(new ArrayBuffer(begin + 3 * 8 + 5));
    sample.setUint8(1, 1);
    sample.setUint32(begin - (members.endsWith("double c;") ? 8 : 4), 3, true);
    [1.5, -2, 1e9].forEach((value, i) => sample.setFloat64(begin + 8 * i, value, true));
    sample.setUint32(begin + 24, 1, true);
    const bytes_of = new Uint8Array(sample.buffer);
    assert.deepEqual([...schema.doubles(bytes_of, "values")], [1.5, -2, 1e9]);
    assert.deepEqual([...schema.message(bytes_of).values], [1.5, -2, 1e9]);
    assert.equal(schema.doubles(bytes_of, "text"), undefined);
    assert.equal(schema.doubles(bytes_of.subarray(0, begin + 8), "values"), undefined);
  }
});

test("of a world that is anything what can be drawn is left", () => {
  const head = "bounds: [0, 0, 9, 9]\nstart: [1, 1, 0]\ntarget: [8, 8]\n";
  const told = [];
  const complain = (kind, text) => {
    if (!told.some(([known]) => known === kind)) told.push([kind, text]);
  };
  for (const none of ["7", head.replace("[0, 0, 9, 9]", "[9, 9, 0, 0]"), head.replace("[1, 1, 0]", "[1, .nan, 0]")]) {
    assert.equal(read_world(none, complain), undefined);
    assert.match(told.pop()?.[1] ?? "", /^world\.yaml (cannot be read \(.+\)|is no world: .+)/);
  }
  assert.ok(read_world(head, complain));
  assert.deepEqual(told, []);
  const world = read_world(`${head}name: {a: 1}\nwalls: [[1, 2, 3, 4], [1], 7]\npolygons: {a: 1}\ncircles: [[1, 1, -1], [2, 2, 1]]
moving: [7, {path: 3}, {circle: [1, 1, 1], path: [[0, 1, 1], []]}]\nwaypoints: [[1, 2], 3, [4, 5, ~, 0], [6, 7, 0.5]]\ntarget_radius: [1]\n`, complain);
  assert.deepEqual(told, [
    ["walls", "walls[1] of the world cannot be read: it is left out"],
    ["polygons", "polygons of the world: no list; they are left out"],
    ["circles", "circles[0] of the world cannot be read: it is left out"],
    ["moving", "moving[0] of the world cannot be read: it is left out"],
    ["path of moving", "path of moving of the world: no list; they are left out"],
    ["waypoints", "waypoints[1] of the world cannot be read: it is left out"],
  ]);
  assert.deepEqual(world.walls, [[1, 2, 3, 4]]);
  assert.deepEqual(world.polygons, []);
  assert.deepEqual(world.circles, [[2, 2, 1]]);
  assert.deepEqual(world.moving, [{ radius_m: 1, corners: [], door: undefined, path: [[0, 1, 1]], loops: false, jumps: false }]);
  assert.deepEqual(world.waypoints, [{ place: [1, 2], radius_m: 0 }, { place: [4, 5], radius_m: 0 }, { place: [6, 7], radius_m: 0.5 }]);
  assert.equal(world.name, "");
});
