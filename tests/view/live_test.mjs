// SPDX-License-Identifier: Apache-2.0
// A run that is watched: the page follows it, and its hash is that of the run without a page.
import assert from "node:assert/strict";
import path from "node:path";
import { test } from "node:test";

import { clew, json_lines, open_browser, open_page, scratch_directory, serve } from "./view_server.mjs";

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

test("a port that is taken is refused before the run", async (context) => {
  const recording = path.join(scratch_directory(context), "a.mcap");
  clew("run", "krishna_kalra", "--layout", "composed", "--max-ticks", "5", "--record", recording);
  const { port } = await serve(context, "view", recording);
  const refused = clew("run", "krishna_kalra", "--layout", "composed", "--view", String(port));
  assert.equal(refused.status, 2);
  assert.match(refused.err, new RegExp(`port ${port} of 127\\.0\\.0\\.1 cannot be taken`));
});
