// SPDX-License-Identifier: Apache-2.0
// A run is controlled from its page, with the mouse; its recording is then replayed exactly.
import assert from "node:assert/strict";
import path from "node:path";
import { test } from "node:test";

import { clew, json_lines, open_browser, open_page, request, scratch_directory, serve, start } from "./view_server.mjs";

// The robot wanders before a wall, for as long as it is let.
const kRun = ["krishna_kalra", "--world", "unsolvable-behind-wall", "--with", "recover.detector=none"];

/// The newest order that the page tells of.
const newest_order = (page) => page.evaluate(() => document.querySelector("#orders li")?.firstChild?.textContent ?? "");
const orders = (page) => page.evaluate(() => document.querySelectorAll("#orders li").length);

/// Does something that gives an order, and waits until the run has answered; the order as told.
async function give(page, what) {
  const before = await orders(page);
  await what();
  await page.waitForFunction((count) => document.querySelectorAll("#orders li").length > count, before);
  return newest_order(page);
}
const tick_of = (told) => Number(/at tick (\d+)$/.exec(told)[1]);

for (const layout of ["processes", "composed"]) {
  test(`a run is controlled from its page (${layout})`, async (context) => {
    const recording = path.join(scratch_directory(context), "controlled.mcap");
    const name = `page-control-${process.pid}-${layout}`;
    const browser = await open_browser(context);
    const served = await serve(context, "run", ...kRun, "--layout", layout, "--pace", "20x", "--name", name, "--record", recording, "--json", "--view");
    const report = new Promise((resolve) => served.lines.on("line", (line) => resolve(JSON.parse(line))));
    const { page, complaints } = await open_page(browser, served.address);
    await page.click("#tab-control");
    await page.waitForFunction(() => window.clew.session.last_tick > 20);

    const paused = tick_of(await give(page, () => page.click("#live-pause")));
    assert.equal(tick_of(await give(page, () => page.click("#live-step"))), paused + 1);
    assert.equal(await page.textContent("#live-pause"), "Resume");
    // A click on the map is the new target.
    await page.click("#live-goal");
    const place = [1, 1];
    const box = await page.locator("#map-canvas").boundingBox();
    const [x, y] = await page.evaluate(([px, py]) => window.clew.map.pixel(px, py), place);
    const goal_tick = tick_of(await give(page, () => page.mouse.click(box.x + x, box.y + y)));
    // Another behaviour, by the form that is made from the registry.
    await page.selectOption("[data-field=stage]", "control");
    await page.selectOption("[data-field=behaviour]", "fuzzy_behaviourist");
    const swap_tick = tick_of(await give(page, () => page.click("#live-swap")));
    assert.ok(swap_tick > goal_tick && goal_tick >= paused + 1);
    await give(page, () => page.selectOption("#pace", "5"));
    await give(page, () => page.click("#live-pause"));
    await page.waitForFunction((tick) => window.clew.session.last_tick > tick + 5, swap_tick);
    await give(page, () => page.click("#live-stop"));

    const told = await report;
    assert.equal(told.outcome, "aborted");
    await page.waitForSelector("body[data-ended]");
    assert.ok(await page.isDisabled("#live-pause"));
    const { interventions } = JSON.parse(clew("info", recording, "--json").out);
    const changes = interventions.filter((each) => each.changes?.length > 0);
    assert.deepEqual(changes.map((each) => each.tick), [goal_tick, swap_tick]);
    const [, goal_x, goal_y] = /^goal=([\d.]+),([\d.]+)$/.exec(changes[0].changes[0]);
    // A pixel is a few centimetres wide.
    assert.ok(Math.hypot(Number(goal_x) - place[0], Number(goal_y) - place[1]) < 0.05);
    assert.match(changes[1].changes[0], /^control(\.behaviour)?=fuzzy_behaviourist$/);
    for (const stage of ["sense", "classify", "recover", "control", "drive"]) {
      const replayed = clew("replay", recording, "--component", stage, "--json");
      assert.equal(replayed.status, 0, replayed.out + replayed.err);
    }
    assert.deepEqual(complaints.filter((text) => !text.includes("ERR_")), []);
  });
}

test("what is refused is said on the page, and only our own page may ask", async (context) => {
  const name = `page-refused-${process.pid}`;
  const browser = await open_browser(context);
  const served = await serve(context, "run", ...kRun, "--pace", "2x", "--name", name, "--view");
  const { page } = await open_page(browser, served.address);
  await page.click("#tab-control");
  // Outside the world.
  await page.click("#live-goal");
  await page.evaluate(() => window.clew.map.zoom(0.2));
  const box = await page.locator("#map-canvas").boundingBox();
  await page.mouse.click(box.x + 5, box.y + 5);
  await page.waitForFunction(() => document.querySelector("#panel-control .warn").textContent.includes("not within the bounds"));

  const own = { Host: `127.0.0.1:${served.port}`, Origin: `http://127.0.0.1:${served.port}`, Cookie: `clew_view_${served.port}=${served.token}` };
  const ask = (headers, body = '{"order": "pause"}') => request(served.port, "/control", headers, "POST", body);
  assert.equal((await ask({ ...own, Origin: "http://evil.example" })).status, 403);
  assert.equal((await ask({ ...own, Cookie: "" })).status, 403);
  assert.equal((await ask({ ...own, Host: `evil.example:${served.port}` })).status, 403);
  const without_origin = { ...own };
  delete without_origin.Origin;
  assert.equal((await ask(without_origin)).status, 403);
  assert.equal((await ask(own, '{"order": "exec"}')).status, 400);
  assert.equal((await ask(own)).status, 200);
  assert.equal(clew("resume", name).status, 0);
});

test("a run is found by its name or its domain, and its page shown", async (context) => {
  const name = `page-found-${process.pid}`;
  const browser = await open_browser(context);
  const domain = "71";
  const run = await serve(context, "run", ...kRun, "--pace", "5x", "--domain", domain, "--name", name, "--view");
  for (const called of [name, domain]) {
    const served = await serve(context, "view", called);
    assert.equal(String(served.address), String(run.address));
    const { page } = await open_page(browser, served.address);
    await page.waitForFunction(() => window.clew.session.last_tick > 5);
    await page.close();
  }
  const without = clew("view", "nobody-is-called-so");
  assert.equal(without.status, 2);
  assert.match(without.err, /no run is called 'nobody-is-called-so'/);
  const last = await serve(context, "view", name);
  assert.equal(clew("stop", name).status, 0);
  assert.equal(await last.ended, 0);
});

for (const layout of ["processes", "composed"]) {
  test(`a run that was started without a page gets one (${layout})`, async (context) => {
    const name = `page-asked-${process.pid}-${layout}`;
    const plain = path.join(scratch_directory(context), "plain.mcap");
    const expected = JSON.parse(clew("run", "krishna_kalra", "--layout", "composed", "--record", plain, "--json").out);
    const browser = await open_browser(context);
    const run = start(context, "run", "krishna_kalra", "--layout", layout, "--pace", "2x", "--name", name, "--json");
    const report = new Promise((resolve) => run.lines.on("line", (line) => resolve(JSON.parse(line))));
    assert.equal(clew("pause", name).status, 0);
    for (let tick = 0; tick < 3; tick++) assert.equal(clew("step", name).status, 0);
    const served = await serve(context, "view", name);
    const again = await serve(context, "view", name);
    assert.equal(String(again.address), String(served.address));
    const { page, complaints } = await open_page(browser, served.address);
    // It is commanded from there, too, and shows what comes from now on.
    for (let steps = 1; steps <= 2; steps++) {
      await page.keyboard.press("j");
      await page.waitForFunction((n) => document.querySelectorAll("#orders li").length === n, steps);
    }
    await page.waitForFunction(() => window.clew.session.runs[0].ticks.length > 0);
    const first = await page.evaluate(() => window.clew.session.first_tick);
    assert.ok(first > 0);
    assert.equal(clew("pace", name, "20x").status, 0);
    assert.equal(clew("resume", name).status, 0);
    await page.waitForSelector("body[data-ended=reached]");
    assert.equal((await report).hash, expected.hash);
    assert.equal(await served.ended, 0);
    const told = json_lines(clew("echo", plain, "state", "--jsonl", "--field", "pose_world_robot").out);
    const by_tick = new Map(told.map(({ tick, pose_world_robot: pose }) => [tick, pose.x_m]));
    const shown = await page.evaluate(() => window.clew.session.runs[0].ticks.map((tick, i) => [tick, window.clew.session.runs[0].truth[i].x]));
    assert.equal(shown.at(-1)[0], expected.ticks);
    for (const [tick, x] of shown) assert.equal(x, by_tick.get(tick));
    assert.deepEqual(complaints.filter((text) => !text.includes("ERR_")), []);
  });
}
