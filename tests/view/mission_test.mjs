// SPDX-License-Identifier: Apache-2.0
// Way-points, changes of a run, and several robots of one world on the page: what it says is what
// `clew events` and `clew info` say.
import assert from "node:assert/strict";
import { readdirSync, writeFileSync } from "node:fs";
import path from "node:path";
import { test } from "node:test";

import { clew, json_lines, open_browser, open_page, scratch_directory, serve } from "./view_server.mjs";

const kWorld = `format: clew-world/1
name: rounds
about: "A round of way-points."
bounds: [0, 0, 10, 8]
walls: [[3, 0, 3, 5], [6.5, 3, 6.5, 8]]
start: [1, 1, 1.57]
waypoints: [[1.2, 6.5], [5, 6.5, 0.4], [5, 1.5]]
target: [9, 7]
target_radius: 0.3
`;

/// The colour of a pixel of the map, at a place of the world.
const colour_at = (page, x, y) => page.evaluate(([px, py]) => {
  const canvas = document.querySelector("#map-canvas");
  const [left, top] = window.clew.map.pixel(px, py);
  return [...canvas.getContext("2d").getImageData(Math.round(left * devicePixelRatio), Math.round(top * devicePixelRatio), 1, 1).data.slice(0, 3)];
}, [x, y]);
const go_to = async (page, tick) => {
  await page.evaluate((to) => window.clew.session.go_to(to), tick);
  await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
};

test("a mission, and another one on the way", async (context) => {
  const directory = scratch_directory(context);
  const file = path.join(directory, "mission.mcap");
  const world = path.join(directory, "rounds.yaml");
  writeFileSync(world, kWorld);
  assert.equal(clew("run", "default", "--world", world, "--layout", "composed", "--record", file,
    "--at", "60:recover.detector=none", "--at", "150:goal=5,1.5/9,1,0.5/9,7").status, 0);
  const served = await serve(context, "view", file);
  const { page, complaints } = await open_page(await open_browser(context), served.address);
  if (process.env.CLEW_SCREENSHOT) await page.screenshot({ path: process.env.CLEW_SCREENSHOT });

  const told = json_lines(clew("events", file, "--json").out).filter(({ kind }) => kind === "waypoint")
    .map(({ tick, text, x_m, y_m }) => ({ tick, text, place: [x_m, y_m] }));
  assert.equal(told.length, 6);
  const events = (kind) => page.evaluate((wanted) => window.clew.session.runs[0].events.filter((each) => each.kind === wanted)
    .map(({ tick, text, place, stage }) => ({ tick, text, place, stage })), kind);
  assert.deepEqual((await events("waypoint")).map(({ tick, text, place }) => ({ tick, text, place })), told);
  assert.deepEqual((await events("change")).map(({ tick, text, stage }) => ({ tick, text, stage })), [
    { tick: 60, text: "recover.detector=none", stage: "recover" }, { tick: 150, text: "goal=5,1.5/9,1,0.5/9,7", stage: "drive" }]);

  await go_to(page, 100);
  assert.match(await page.textContent("#now"), /way-points reached2 of 4/);
  // The ring of the second way-point, and after the change that of the new one, beside lines of the grid.
  const second = [5 + 0.4 * Math.SQRT1_2, 6.5 + 0.4 * Math.SQRT1_2];
  const other = [9 + 0.5 * Math.SQRT1_2, 1 + 0.5 * Math.SQRT1_2];
  const ground = await colour_at(page, 8.2, 1.7);
  assert.notDeepEqual(await colour_at(page, ...second), ground);
  assert.deepEqual(await colour_at(page, ...other), ground);
  await go_to(page, 160);
  assert.match(await page.textContent("#now"), /way-points reached0 of 3/);
  assert.notDeepEqual(await colour_at(page, ...other), ground);
  assert.deepEqual(await colour_at(page, ...second), ground);
  assert.deepEqual(complaints, []);
});

test("with odometry that drifts, way-points and headings are those that the robot took them for", async (context) => {
  const directory = scratch_directory(context);
  const file = path.join(directory, "drift.mcap");
  const world = path.join(directory, "turns.yaml");
  writeFileSync(world, kWorld.replace("[5, 6.5, 0.4]", "[5, 6.5, ~, 0, 0.6]").replace("target: ", "target_heading: [1.57, 0.8]\ntarget: "));
  clew("run", "default", "--world", world, "--layout", "composed", "--set", "drive.drift_m_per_m=0.05", "--max-ticks", "400", "--record", file);
  const { page, complaints } = await open_page(await open_browser(context), (await serve(context, "view", file)).address);

  const told = json_lines(clew("events", file, "--json").out).filter(({ kind }) => kind === "waypoint").map(({ tick, text }) => ({ tick, text }));
  assert.ok(told.length >= 2);
  assert.deepEqual(await page.evaluate(() => window.clew.session.runs[0].events.filter((each) => each.kind === "waypoint")
    .map(({ tick, text }) => ({ tick, text }))), told);
  // The place, the radius where none is given, and the heading of the second one.
  assert.deepEqual(await page.evaluate(() => window.clew.session.runs[0].world.waypoints[1]), { place: [5, 6.5], radius_m: 0.3 });
  await go_to(page, told[0].tick + 1);
  assert.match(await page.textContent("#now"), /sent toway-point 2: 5\.00, 6\.50 m, heading 0 ± 34°/);
  if (process.env.CLEW_SCREENSHOT) await page.screenshot({ path: process.env.CLEW_SCREENSHOT });
  assert.deepEqual(complaints, []);
});

test("the robots of a fleet lie over each other, each with its own way", async (context) => {
  const directory = path.join(scratch_directory(context), "gap");
  assert.equal(clew("run", "two_at_a_gap", "--record", directory).status, 0);
  const files = readdirSync(directory).sort().map((name) => path.join(directory, name));
  assert.equal(files.length, 2);
  const served = await serve(context, "view", ...files);
  const { page, complaints } = await open_page(await open_browser(context), served.address);
  await go_to(page, 50);
  const robots = await page.evaluate(() => window.clew.session.runs.map((run) => run.truth[run.index_at(50)]));
  const colours = await page.evaluate(([x, y]) => {
    const found = new Set();
    const canvas = document.querySelector("#map-canvas");
    const [left, top] = window.clew.map.pixel(x, y);
    const data = canvas.getContext("2d").getImageData(left * devicePixelRatio - 20, top * devicePixelRatio - 20, 40, 40).data;
    for (let i = 0; i < data.length; i += 4) found.add(`${data[i]},${data[i + 1]},${data[i + 2]}`);
    return [...found];
  }, [robots[1].x, robots[1].y]);
  // The second robot is drawn as a run, in its orange, and not as a grey obstacle of the first.
  assert.ok(colours.includes("213,94,0"), colours.join(" "));
  assert.ok(!colours.includes("138,144,153"));
  assert.deepEqual(complaints, []);
});
