// SPDX-License-Identifier: Apache-2.0
// What if, on the page: a branch and a run have the hash that the command line shown gives.
import assert from "node:assert/strict";
import path from "node:path";
import { test } from "node:test";

import { clew, open_browser, open_page, request, scratch_directory, serve } from "./view_server.mjs";

const hash_of = (file) => JSON.parse(clew("info", file, "--json").out).hash;

/// What the page lists last, once it has one more.
async function next_branch(page, count) {
  await page.waitForFunction((n) => document.querySelectorAll("#branches li").length === n, count, { timeout: 60000 });
  return page.evaluate(() => {
    const { runs } = window.clew.session;
    return { command: document.querySelector("#branches code").textContent, hash: runs[runs.length - 1].recording.end.hash };
  });
}

test("branches and runs from the page", async (context) => {
  const directory = scratch_directory(context);
  const left = path.join(directory, "left.mcap");
  assert.equal(clew("run", "krishna_kalra", "--layout", "composed", "--record", left).status, 0);
  const served = await serve(context, "view", left);
  const { page, complaints } = await open_page(await open_browser(context), served.address);
  await page.click("#tab-what-if");

  await context.test("another behaviour from a tick on", async () => {
    await page.fill("#tick", "100");
    await page.keyboard.press("Enter");
    await page.selectOption("[data-field=stage]", "recover");
    await page.selectOption("[data-field=part]", "detector");
    await page.selectOption("[data-field=behaviour]", "none");
    await page.fill("[aria-label='Most ticks']", "400");
    await page.click("#branch");
    const { command, hash } = await next_branch(page, 1);

    const again = path.join(directory, "again.mcap");
    clew("replay", left, "--branch", "100", "--with", "recover.detector=none", "--max-ticks", "400", "--record", again);
    assert.equal(hash, hash_of(again));
    assert.ok(command.startsWith(`clew replay ${left} --branch=100 --with=recover.detector=none --max-ticks=400 --record `), command);
  });

  await context.test("another value, in its range only", async () => {
    await page.selectOption("[data-field=behaviour]", "landmark_revisit");
    await page.selectOption("[data-field=stage]", "sense");
    await page.fill("[data-parameter=range_m]", "1.2");
    await page.keyboard.press("Tab");
    await page.click("#branch");
    const { hash } = await next_branch(page, 2);

    const again = path.join(directory, "again2.mcap");
    clew("replay", left, "--branch", "100", "--set", "sense.range_m=1.2", "--max-ticks", "400", "--record", again);
    assert.equal(hash, hash_of(again));

    await page.fill("[data-parameter=range_m]", "1000");
    await page.keyboard.press("Tab");
    await page.click("#branch");
    await page.waitForFunction(() => document.querySelector("[role=alert]").textContent.includes("allowed"));
  });

  await context.test("a world that is drawn with the mouse", async () => {
    await page.selectOption("#run-graph", "reactive");
    await page.selectOption("#run-world", "");
    await page.waitForSelector("#drawing button");
    const map = await page.locator("#map-canvas").boundingBox();
    const pixel = (x, y) => page.evaluate(([wx, wy]) => window.clew.map.pixel(wx, wy), [x, y]);
    const [fx, fy] = await pixel(2, 4);
    const [tx, ty] = await pixel(4, 4);
    await page.mouse.move(map.x + fx, map.y + fy);
    await page.mouse.down();
    await page.mouse.move(map.x + tx, map.y + ty, { steps: 3 });
    await page.mouse.up();
    await page.fill("[aria-label='Most ticks']", "300");
    await page.click("#run");
    const { command } = await next_branch(page, 3);

    const world = /--world (\S+)/.exec(command)[1];
    const again = path.join(directory, "drawn.mcap");
    clew("run", "reactive", "--world", world, "--layout", "composed", "--max-ticks", "300", "--record", again);
    const shown = await page.evaluate(() => window.clew.session.run.recording.end.hash);
    assert.equal(shown, hash_of(again));
    assert.deepEqual(await page.evaluate(() => window.clew.session.run.world.walls), [[2, 4, 4, 4]]);
  });

  assert.deepEqual(complaints.filter((text) => !text.includes("400 (Bad Request)")), []);
});

test("the page can name no program, no path and no plug-in", async (context) => {
  const directory = scratch_directory(context);
  const file = path.join(directory, "a.mcap");
  clew("run", "krishna_kalra", "--layout", "composed", "--max-ticks", "20", "--record", file);
  const { port, token } = await serve(context, "view", file);
  const own = { Cookie: `clew_view_${port}=${token}`, Origin: `http://127.0.0.1:${port}` };
  const base = { recording: 0, tick: 5, max_ticks: 10 };
  const attempts = [
    { ...base, with: { "control.behaviour": ["/bin/sh"] } },
    { ...base, with: { "control.exec": ["sh"] } },
    { ...base, with: { control: ["reactive"] } },
    { ...base, recording: 1 },
    { ...base, tick: -1 },
    { ...base, tick: "5 --record=/tmp/x" },
    { ...base, max_ticks: 1e12 },
    { ...base, set: [{ stage: "control", part: "behaviour", behaviour: "krishna_kalra_fuzzy", name: "rules", value: "../../etc/passwd" }] },
    { ...base, set: [{ stage: "sense", part: "behaviour", behaviour: "cones", name: "range_m", value: "1; rm" }] },
    { ...base, set: [{ stage: "sense", part: "behaviour", behaviour: "cones", name: "exec", value: 1 }] },
    { ...base, rules: [{ stage: "sense", part: "behaviour", behaviour: "cones", name: "range_m", text: "format: x" }] },
    { ...base, rules: [{ stage: "control", part: "behaviour", behaviour: "krishna_kalra_fuzzy", name: "rules", text: "x".repeat(70000) }] },
    { ...base, rules: [{ stage: "control", part: "behaviour", behaviour: "krishna_kalra_fuzzy", name: "rules" }] },
    { ...base, rules: [{ stage: "control", part: "behaviour", behaviour: "krishna_kalra_fuzzy", name: "rules", text: "format: other/1\n" }] },
    [], "text", null,
  ];
  for (const attempt of attempts) {
    const answer = await request(port, "/branch", own, "POST", JSON.stringify(attempt));
    assert.equal(answer.status, 400, JSON.stringify(attempt));
    assert.ok(JSON.parse(answer.body).error.length > 0);
  }
  for (const attempt of [{ graph: "./evil.yaml", world: "u-trap", max_ticks: 5 }, { graph: "default", world: "/etc/passwd", max_ticks: 5 },
    { graph: "default", world: { bounds: [0, 0, 1], start: [0, 0, 0], target: [1, 1], target_radius: 1 }, max_ticks: 5 },
    { graph: "default", world: { bounds: [0, 0, 9, 9], start: [1, 1, 0], target: [1, "1]\nname: x"], target_radius: 1 }, max_ticks: 5 }]) {
    assert.equal((await request(port, "/run", own, "POST", JSON.stringify(attempt))).status, 400, JSON.stringify(attempt));
  }
  assert.equal((await request(port, "/branch", { Cookie: own.Cookie }, "POST", JSON.stringify(base))).status, 403);
});
