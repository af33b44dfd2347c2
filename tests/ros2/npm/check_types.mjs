// SPDX-License-Identifier: Apache-2.0
// Our types of ROS 2 against the official definitions: names, hashes, field by field.
//   node check_types.mjs DESCRIBE_TYPES_PROGRAM
import { parse } from "@foxglove/rosmsg";
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { createHash } from "node:crypto";

import { definitionsOf, distributions, hashOf, layoutOf } from "./official_types.mjs";

// Published by the distributions themselves.
const published = {
  "geometry_msgs/msg/Twist": "9c45bf16fe0983d80e3cfe750d6835843d265a9a6c46bd2e609fcddde6fb8d2a",
  "sensor_msgs/msg/LaserScan": "64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828",
  "nav_msgs/msg/Odometry": "3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0",
  "tf2_msgs/msg/TFMessage": "e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087",
  "diagnostic_msgs/msg/DiagnosticArray":
    "5a8a36efb05fb25070fa0fb3810290c0e6cd4862b54a8fb975a1ee8dc55a333e",
  "rmw_dds_common/msg/ParticipantEntitiesInfo":
    "91a0593bacdcc50ea9bdcf849a938b128412cc1ea821245c663bcd26f83c295e",
};

const types = execFileSync(process.argv[2], { encoding: "utf8" })
  .trim()
  .split("\n")
  .map((line) => JSON.parse(line));
assert.ok(types.length >= 15);
for (const type of types) {
  assert.equal(type.hash, hashOf(type.name), type.name);
  assert.equal(
    type.hash,
    "RIHS01_" + createHash("sha256").update(type.description).digest("hex"),
  );
  if (published[type.name]) assert.equal(type.hash, "RIHS01_" + published[type.name]);
  const [group, , name] = type.name.split("/");
  assert.equal(type.dds_name, `${group}::msg::dds_::${name}_`);

  // The definition that bags carry says the same.
  const parsed = parse(type.definition, { ros2: true });
  const official = definitionsOf(type.name);
  const own = parsed.find((one) => one.name === undefined);
  assert.deepEqual(
    own.definitions.map((field) => field.name),
    official.get(type.name).map((field) => field.name),
  );
  if (type.name.startsWith("rmw_dds_common")) continue;
  assert.deepEqual(
    layoutOf(type.name, distributions.ros2jazzy),
    layoutOf(type.name, distributions.ros2humble),
    `${type.name} is the same in both distributions`,
  );
}
assert.equal(types.filter((type) => published[type.name]).length, Object.keys(published).length);
console.log(`${types.length} types, each as the official definitions have it`);
