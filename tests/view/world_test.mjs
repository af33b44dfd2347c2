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
const { place_at, read_world } = await import(`data:text/javascript;base64,${script}`);

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
