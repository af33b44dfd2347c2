// SPDX-License-Identifier: Apache-2.0
// A run that is watched: the page follows it, and its hash is that of the run without a page.
import assert from "node:assert/strict";
import path from "node:path";
import { test } from "node:test";

import { clew, json_lines, open_browser, open_page, scratch_directory, serve, start } from "./view_server.mjs";

for (const layout of ["processes", "composed"]) {
  test(`the page follows a run (${layout})`, async (context) => {
    const recording = path.join(scratch_directory(context), "watched.mcap");
    const plain = JSON.parse(clew("run", "krishna_kalra", "--layout", "composed", "--json").out);
    const browser = await open_browser(context);
    const served = await serve(context, "run", "krishna_kalra", "--layout", layout, "--pace", "6x", "--record", recording, "--json", "--view");
    const report = new Promise((resolve) => served.lines.on("line", (line) => resolve(JSON.parse(line))));
    const { page, complaints } = await open_page(browser, served.address);

    await page.waitForFunction(() => window.clew.session.last_tick > 20);
    const before = await page.evaluate(() => window.clew.session.tick);
    await page.waitForFunction((tick) => window.clew.session.tick > tick + 5 || document.body.dataset.ended, before);
    assert.equal((await report).hash, plain.hash);
    await page.waitForSelector("body[data-ended=reached]");
    const told = json_lines(clew("echo", recording, "state", "--jsonl", "--field", "pose_world_robot").out);
    const shown = await page.evaluate(() => window.clew.session.runs[0].ticks.map((tick, i) => [tick, window.clew.session.runs[0].truth[i].x]));
    const by_tick = new Map(told.map(({ tick, pose_world_robot: pose }) => [tick, pose.x_m]));
    assert.ok(shown.length > 100);
    for (const [tick, x] of shown) assert.equal(x, by_tick.get(tick));
    assert.equal(await page.evaluate(() => window.clew.session.last_tick), plain.ticks);
    assert.deepEqual(complaints.filter((text) => !text.includes("ERR_")), []);
  });
}

for (const layout of ["processes", "composed"]) {
  test(`the insides of a run under way are those of its recording (${layout})`, async (context) => {
    const recording = path.join(scratch_directory(context), "asked.mcap");
    const name = `page-insides-${process.pid}-${layout}`;
    const browser = await open_browser(context);
    // It wanders before a wall for as long as it is let, and learns of a new target on its way.
    const served = await serve(context, "run", "default", "--world", "unsolvable-behind-wall", "--set", "recover.escape.remembered_map.proof_s=10000",
      "--layout", layout, "--pace", "30x", "--name", name, "--record", recording, "--json", "--view");
    const { page, complaints } = await open_page(browser, served.address);
    await page.waitForFunction(() => window.clew.session.last_tick > 40);
    assert.equal(clew("goal", name, "9", "1").status, 0);
    const changed = await page.evaluate(() => window.clew.session.last_tick);
    await page.waitForFunction((tick) => window.clew.session.last_tick > tick + 40, changed);
    assert.equal(clew("pause", name).status, 0);
    await page.keyboard.press("x");
    await page.waitForFunction(() => document.querySelector("#insides").dataset.tick, undefined, { timeout: 60000 });
    // In one look: what comes late makes the page ask for a later tick.
    const { tick, texts } = await page.evaluate(() => ({
      tick: Number(document.querySelector("#insides").dataset.tick),
      texts: [...document.querySelectorAll("#insides section")].map((each) => [each.dataset.stage, each.querySelector(".told").textContent]),
    }));
    assert.ok(tick > 40 && tick <= await page.evaluate(() => window.clew.session.last_tick));
    assert.ok(await page.locator("#map-legend label").count() > 0);
    if (process.env.CLEW_SCREENSHOT) await page.screenshot({ path: process.env.CLEW_SCREENSHOT });

    assert.equal(clew("stop", name).status, 0);
    await served.ended;
    const told = json_lines(clew("explain", recording, "--tick", String(tick), "--json").out);
    assert.deepEqual(texts, told.map(({ stage, text }) => [stage, text]));
    assert.deepEqual(complaints.filter((text) => !text.includes("ERR_")), []);
  });
}

/// Gives an order until the run, which may have to start first, carries it out; from which tick on it holds.
async function tick_once_carried(...order) {
  const deadline = Date.now() + 60000;
  for (;;) {
    const done = clew(...order, "--json");
    if (done.status === 0) return JSON.parse(done.out).tick;
    assert.ok(Date.now() < deadline, done.err);
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
}

for (const layout of ["processes", "composed"]) {
  test(`a page that is opened late tells the insides of what comes then (${layout})`, async (context) => {
    const recording = path.join(scratch_directory(context), "late.mcap");
    const name = `page-late-${process.pid}-${layout}`;
    const browser = await open_browser(context);
    const run = start(context, "run", "default", "--world", "unsolvable-behind-wall", "--set", "recover.escape.remembered_map.proof_s=10000",
      "--layout", layout, "--pace", "100x", "--name", name, "--record", recording, "--json");
    // Another behaviour before the page, and another while it looks on; the page has no tick that either was fed with.
    const early = await tick_once_carried("swap", name, "recover.detector=none");
    // A pause tells where the run is.
    for (let at = 0; at <= early;) {
      at = await tick_once_carried("pause", name);
      await tick_once_carried("resume", name);
    }
    const served = await serve(context, "view", name);
    const { page, complaints } = await open_page(browser, served.address);
    await page.waitForFunction(() => window.clew.session.runs[0].ticks.length > 0);
    const first = await page.evaluate(() => window.clew.session.first_tick);
    assert.ok(first > early, `${first} ${early}`);
    // Two checkpoints lie behind it by then.
    await page.waitForFunction((tick) => window.clew.session.last_tick > tick + 150, first);
    assert.equal(clew("swap", name, "recover.detector=known_detour").status, 0);
    // It takes over some ticks later, and the page hears of it later still.
    const changed = () => window.clew.session.runs[0].recording.changes.map(({ tick }) => tick).at(-1);
    await page.waitForFunction((tick) => window.clew.session.runs[0].recording.changes.some((each) => each.tick > tick), first);
    const swapped = await page.evaluate(changed);
    await page.waitForFunction((tick) => window.clew.session.last_tick > tick + 300, swapped);
    assert.equal(clew("pause", name).status, 0);
    await page.keyboard.press("x");
    await page.waitForFunction((tick) => Number(document.querySelector("#insides").dataset.tick) > tick + 100, swapped, { timeout: 60000 });
    const { tick, texts } = await page.evaluate(() => ({
      tick: Number(document.querySelector("#insides").dataset.tick),
      texts: [...document.querySelectorAll("#insides section")].map((each) => [each.dataset.stage, each.querySelector(".told").textContent]),
    }));
    // Of a tick that came with the page itself nothing before it is known.
    await page.fill("#tick", String(first));
    await page.keyboard.press("Enter");
    await page.waitForFunction(() => document.querySelector("#insides").textContent.includes("is not held here"), undefined, { timeout: 60000 });

    assert.equal(clew("stop", name).status, 0);
    await run.ended;
    const told = json_lines(clew("explain", recording, "--tick", String(tick), "--json").out);
    assert.deepEqual(texts, told.map(({ stage, text }) => [stage, text]));
    assert.deepEqual(complaints.filter((text) => !text.includes("ERR_") && !text.includes("409")), []);
  });
}

test("a killed component is on the lanes of a page, and in no recording", async (context) => {
  const recording = path.join(scratch_directory(context), "killed.mcap");
  const name = `page-killed-${process.pid}`;
  const browser = await open_browser(context);
  const served = await serve(context, "run", "krishna_kalra", "--world", "unsolvable-behind-wall", "--with", "recover.detector=none",
    "--pace", "20x", "--name", name, "--record", recording, "--json", "--view");
  const { page } = await open_page(browser, served.address);
  await page.waitForFunction(() => window.clew.session.last_tick > 20);
  const { pid } = json_lines(clew("top", name, "--once", "--json").out).find(({ stage }) => stage === "recover");
  process.kill(pid, "SIGKILL");
  await page.waitForFunction(() => window.clew.session.runs[0].events.some(({ kind }) => kind === "restart"), undefined, { timeout: 60000 });
  const event = await page.evaluate(() => window.clew.session.runs[0].events.find(({ kind }) => kind === "restart"));
  assert.equal(event.stage, "recover");
  assert.match(event.text, /^recover \(process \d+\) .*; restarting it$/);
  if (process.env.CLEW_SCREENSHOT) await page.screenshot({ path: process.env.CLEW_SCREENSHOT });
  assert.equal(clew("stop", name).status, 0);
  await served.ended;
  assert.ok(json_lines(clew("events", recording, "--json").out).every(({ kind }) => kind !== "restart"));
});

test("a port that is taken is refused before the run", async (context) => {
  const recording = path.join(scratch_directory(context), "a.mcap");
  clew("run", "krishna_kalra", "--layout", "composed", "--max-ticks", "5", "--record", recording);
  const { port } = await serve(context, "view", recording);
  const refused = clew("run", "krishna_kalra", "--layout", "composed", "--view", String(port));
  assert.equal(refused.status, 2);
  assert.match(refused.err, new RegExp(`port ${port} of 127\\.0\\.0\\.1 cannot be taken`));
});
