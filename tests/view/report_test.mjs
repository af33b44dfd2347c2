// SPDX-License-Identifier: Apache-2.0
// `clew report`: one file that opens without a server, is small, and lets no text of a recording
// become HTML.
import assert from "node:assert/strict";
import { copyFileSync, readFileSync, readdirSync, statSync, writeFileSync } from "node:fs";
import path from "node:path";
import { test } from "node:test";
import { pathToFileURL } from "node:url";

import { clew, json_lines, open_browser, open_page, request, require, scratch_directory, serve, ticks_of } from "./view_server.mjs";

const { McapStreamReader, McapWriter } = require("@mcap/core");

/// A recording in which the odometry of a tick is no message.
async function spoilt(file, tick) {
  const pieces = [];
  const writer = new McapWriter({
    writable: { position: () => BigInt(pieces.reduce((sum, each) => sum + each.length, 0)), write: async (piece) => { pieces.push(piece.slice()); } },
    useChunks: false,
  });
  await writer.start({ profile: "", library: "test" });
  const reader = new McapStreamReader();
  reader.append(readFileSync(file));
  const ids = { Schema: new Map(), Channel: new Map() };
  let odometry;
  for (let record = reader.nextRecord(); record; record = reader.nextRecord()) {
    if (record.type === "Schema" && !ids.Schema.has(record.id)) ids.Schema.set(record.id, await writer.registerSchema(record));
    if (record.type === "Channel" && !ids.Channel.has(record.id)) {
      if (/odometry$/.test(record.topic)) odometry = record.id;
      ids.Channel.set(record.id, await writer.registerChannel({ ...record, schemaId: ids.Schema.get(record.schemaId) ?? 0 }));
    }
    if (record.type === "Metadata") await writer.addMetadata(record);
    if (record.type === "Attachment") await writer.addAttachment(record);
    if (record.type !== "Message") continue;
    const is_it = record.channelId === odometry && record.sequence === tick;
    await writer.addMessage({ ...record, channelId: ids.Channel.get(record.channelId), data: is_it ? record.data.slice(0, 3) : record.data });
  }
  await writer.end();
  return Buffer.concat(pieces);
}

test("a report holds the run and needs nobody", async (context) => {
  const directory = scratch_directory(context);
  const recordings = ["none", "zstd", "lz4"].map((compression) => {
    const file = path.join(directory, `${compression}.mcap`);
    assert.equal(clew("run", "krishna_kalra", "--layout", "composed", "--compression", compression, "--record", file).status, 0);
    return file;
  });
  const browser = await open_browser(context);

  for (const file of recordings) {
    const output = `${file}.html`;
    assert.equal(clew("report", file, "-o", output).status, 0);
    assert.ok(statSync(output).size <= 1.5 * statSync(recordings[1]).size + 400000, `${statSync(output).size} bytes`);
  }

  const { page, complaints } = await open_page(browser, pathToFileURL(`${recordings[2]}.html`));
  const requests = [];
  page.on("request", (request) => requests.push(request.url()));
  const hash = /hash ([0-9a-f]{32})/.exec(clew("info", recordings[0]).out.replace(/ +/g, " "))[1];
  assert.ok((await page.textContent("#about")).includes(hash));
  assert.equal(await page.evaluate(() => window.clew.session.last_tick), ticks_of(recordings[0]) - 1);
  assert.deepEqual(requests, []);
  assert.deepEqual(complaints, []);
});

test("a recording that is split is shown as one, by a report and by the server", async (context) => {
  const directory = scratch_directory(context);
  const whole = path.join(directory, "whole.mcap");
  const split = path.join(directory, "split.mcap");
  const order = ["run", "default", "--layout", "composed", "--at", "60:recover.detector=none", "--max-ticks", "200"];
  assert.equal(clew(...order, "--record", whole).status, 3);
  assert.equal(clew(...order, "--record", split, "--split-s", "5").status, 3);
  const files = readdirSync(directory).filter((name) => name.startsWith("split"));
  assert.ok(files.length >= 3, `${files}`);
  const output = path.join(directory, "split.html");
  assert.equal(clew("report", split, "-o", output).status, 0);
  assert.equal(clew("report", split, "-o", path.join(directory, "split_1.mcap")).status, 2);
  const { address, port, token } = await serve(context, "view", split, whole);
  const browser = await open_browser(context);
  const facts = (page) => page.evaluate(() => window.clew.session.runs.map(({ ticks, events, outcome, recording }) =>
    ({ ticks: ticks.length, last: ticks[ticks.length - 1], events, outcome, end: recording.end, changes: recording.changes })));

  const { page: served, complaints } = await open_page(browser, address);
  const [of_split, of_whole] = await facts(served);
  assert.deepEqual(of_split, of_whole);
  assert.equal(of_split.ticks, ticks_of(whole));
  assert.equal(of_split.end.hash, JSON.parse(clew("info", whole, "--json").out).hash);
  await served.keyboard.press("d");
  assert.match(await served.textContent("#notice"), /the two recordings hold the same samples/);
  // What comes after a change cannot be branched off, and the page says so at once.
  await served.evaluate(() => window.clew.session.go_to(100));
  await served.keyboard.press("b");
  assert.match(await served.textContent("#no-branch"), /the run was changed at tick 60: choose a tick before it/);
  assert.ok(await served.isDisabled("#branch"));
  // A branch and insides of it go by its first file.
  await served.evaluate(() => window.clew.session.go_to(50));
  await served.keyboard.press("b");
  await served.waitForFunction(() => window.clew.session.runs.length === 3, undefined, { timeout: 60000 });
  // The chosen run is that of the split recording still: its insides are those that the command tells of the whole one.
  await served.keyboard.press("x");
  await served.waitForFunction(() => document.querySelector("#insides").dataset.tick === "50", undefined, { timeout: 60000 });
  assert.equal(await served.evaluate(() => window.clew.session.chosen), 0);
  const insides = await served.$$eval("#insides section", (all) => all.map((each) => [each.dataset.stage, each.querySelector(".told").textContent]));
  assert.deepEqual(insides, json_lines(clew("explain", whole, "--tick", "50", "--json").out).map(({ stage, text }) => [stage, text]));
  assert.deepEqual(complaints, []);

  const { page } = await open_page(browser, pathToFileURL(output));
  assert.deepEqual(await facts(page), [of_split]);
  const cookie = { Cookie: `clew_view_${port}=${token}` };
  assert.equal((await request(port, `/recordings/0/${files.length - 1}`, cookie)).status, 200);
  for (const place of [`0/${files.length}`, "0/", "0/-1", "0/1/0", "9/0", "/0"]) {
    assert.equal((await request(port, `/recordings/${place}`, cookie)).status, 404, place);
  }
});

test("what cannot be read is told, however late it comes, and the rest is shown", async (context) => {
  const directory = scratch_directory(context);
  const whole = path.join(directory, "whole.mcap");
  const file = path.join(directory, "spoilt.mcap");
  assert.equal(clew("run", "krishna_kalra", "--world", "unsolvable-behind-wall", "--with", "recover.detector=none", "--layout", "composed",
    "--max-ticks", "6000", "--compression", "none", "--record", whole).status, 3);
  writeFileSync(file, await spoilt(whole, 5990));
  const output = path.join(directory, "spoilt.html");
  const made = clew("report", file, "-o", output);
  assert.equal(made.status, 0, made.err);

  const { page, complaints } = await open_page(await open_browser(context), pathToFileURL(output));
  await page.waitForFunction(() => document.querySelector("#left-out").textContent !== "");
  assert.equal(await page.textContent("#left-out"), "spoilt.mcap: topic 'odometry' at tick 5990 is no message of its type: it is left out");
  await page.waitForFunction(() => window.clew.session.last_tick === 6000);
  assert.deepEqual(complaints, []);
});

test("a name that is HTML stays a name", async (context) => {
  const directory = scratch_directory(context);
  const plain = path.join(directory, "plain.mcap");
  assert.equal(clew("run", "krishna_kalra", "--layout", "composed", "--max-ticks", "20", "--record", plain).status, 3);
  const name = "<img src=x onerror=\"document.title='owned'\"><\\script>$&.mcap";
  copyFileSync(plain, path.join(directory, name));
  const output = path.join(directory, "report.html");
  assert.equal(clew("report", path.join(directory, name), "-o", output).status, 0);

  assert.ok(!readFileSync(output, "utf8").includes("onerror=\"document"));
  const { page } = await open_page(await open_browser(context), pathToFileURL(output));
  assert.equal(await page.title(), "Clew");
  assert.equal(await page.textContent("#runs button"), name);
});

test("a report that cannot be written says why", (context) => {
  const directory = scratch_directory(context);
  const file = path.join(directory, "a.mcap");
  clew("run", "krishna_kalra", "--layout", "composed", "--max-ticks", "5", "--record", file);
  assert.equal(clew("report", file, "-o", path.join(directory, "no", "such.html")).status, 2);
  assert.equal(clew("report", file, "-o", file).status, 2);
  assert.equal(clew("report", path.join(directory, "missing.mcap"), "-o", "x.html").status, 2);
});
