// SPDX-License-Identifier: Apache-2.0
// The world of a run as the page reads it; without a browser.
import assert from "node:assert/strict";
import { createRequire } from "node:module";
import path from "node:path";
import { test } from "node:test";

const page = process.env.CLEW_PAGE_DIR;
const { build } = createRequire(path.join(page, "package.json"))("esbuild");
const made = await build({
  entryPoints: [path.join(page, "src/world.ts")], bundle: true, write: false, format: "esm",
});
const script = Buffer.from(made.outputFiles[0].contents).toString("base64");
const { corners_at, place_at, read_world } = await import(`data:text/javascript;base64,${script}`);

const head = "bounds: [0, 0, 9, 9]\nstart: [1, 1, 0]\ntarget: [8, 8]\n";
const moving = (more) => read_world(
  `${head}moving: [{circle: [1, 2, 0.2], path: [[0, 1, 2], [0.3, 3, 2], [1, 3, 4]]${more}}]\n`).moving[0];

test("moving obstacles move between the points", () => {
  const [x, y] = place_at(moving(""), 0.15);
  assert.ok(Math.abs(x - 2) < 1e-9 && y === 2);
  assert.deepEqual(place_at(moving(", loop: true"), 1), [1, 2]);
});

test("those that jump stand at each until after the time of the next", () => {
  const jumper = moving(", jumps: true");
  assert.deepEqual(place_at(jumper, 0), [1, 2]);
  assert.deepEqual(place_at(jumper, 0.15), [1, 2]);
  // Three ticks of 0.1 s add up to a little more than 0.3.
  assert.deepEqual(place_at(jumper, 0.1 + 0.1 + 0.1), [1, 2]);
  assert.deepEqual(place_at(jumper, 0.4), [3, 2]);
  assert.deepEqual(place_at(jumper, 1), [3, 2]);
  assert.deepEqual(place_at(jumper, 1.1), [3, 4]);
});

test("doors turn, and polygons move with their first point", () => {
  const [door, polygon] = read_world(`${head}moving:
  - {door: [2, 3, 1.5], turns: [[0, 0], [2, 3.14159265358979]], loop: true}
  - {polygon: [[5, 5], [6, 5], [6, 6]], path: [[0, 5, 5], [2, 7, 5]]}
`).moving;
  const near = (found, told) => found.flat().forEach((value, i) => assert.ok(Math.abs(value - told.flat()[i]) < 1e-9, `${found}`));
  near(corners_at(door, 0), [[2, 3], [3.5, 3]]);
  near(corners_at(door, 1), [[2, 3], [2, 4.5]]);
  near(corners_at(door, 3), [[2, 3], [2, 4.5]]);
  near(corners_at(polygon, 1), [[6, 5], [7, 5], [7, 6]]);
  assert.deepEqual(corners_at(moving(""), 0), []);
});
