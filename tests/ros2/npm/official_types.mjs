// SPDX-License-Identifier: Apache-2.0
// The official definitions of messages, as the npm packages have them: decoders, and type hashes
// computed anew.
import common from "@foxglove/rosmsg-msgs-common";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import { createHash } from "node:crypto";

const { ros2jazzy, ros2humble } = common;

// The package calls these by names of their own, and has no messages of rmw_dds_common.
const time = [
  { type: "int32", name: "sec" },
  { type: "uint32", name: "nanosec" },
];
const extra = {
  "builtin_interfaces/msg/Time": time,
  "builtin_interfaces/msg/Duration": time,
  "rmw_dds_common/msg/Gid": [{ type: "uint8", name: "data", isArray: true, arrayLength: 16 }],
  "rmw_dds_common/msg/NodeEntitiesInfo": [
    { type: "string", upperBound: 256, name: "node_namespace" },
    { type: "string", upperBound: 256, name: "node_name" },
    { type: "rmw_dds_common/msg/Gid", isComplex: true, isArray: true, name: "reader_gid_seq" },
    { type: "rmw_dds_common/msg/Gid", isComplex: true, isArray: true, name: "writer_gid_seq" },
  ],
  "rmw_dds_common/msg/ParticipantEntitiesInfo": [
    { type: "rmw_dds_common/msg/Gid", isComplex: true, name: "gid" },
    {
      type: "rmw_dds_common/msg/NodeEntitiesInfo",
      isComplex: true,
      isArray: true,
      name: "node_entities_info_seq",
    },
  ],
};

function fullName(type) {
  if (type === "time") return "builtin_interfaces/msg/Time";
  if (type === "duration") return "builtin_interfaces/msg/Duration";
  const parts = type.split("/");
  return parts.length === 2 ? `${parts[0]}/msg/${parts[1]}` : type;
}

function fieldsOf(name, distribution) {
  if (extra[name]) return extra[name];
  const found = distribution[name] ?? distribution[name.replace("/msg/", "/")];
  if (!found) throw new Error(`no definition of ${name}`);
  return found.definitions.filter((field) => !field.isConstant);
}

/** All definitions that a message needs, itself first. */
export function definitionsOf(name, distribution = ros2jazzy) {
  const found = new Map();
  const visit = (type) => {
    if (found.has(type)) return;
    const fields = fieldsOf(type, distribution);
    found.set(type, fields);
    for (const field of fields) if (fullName(field.type).includes("/")) visit(fullName(field.type));
  };
  visit(name);
  return found;
}

// type_description_interfaces/msg/FieldType
const ids = {
  int8: 2, uint8: 3, int16: 4, uint16: 5, int32: 6, uint32: 7, int64: 8, uint64: 9,
  float32: 10, float64: 11, bool: 15, string: 17,
};
const boundedString = 21;

function describedType(owner, field) {
  const nested = fullName(field.type).includes("/");
  let id = nested ? 1 : ids[field.type];
  // The package no longer tells a byte from a uint8.
  if (owner === "diagnostic_msgs/msg/DiagnosticStatus" && field.name === "level") id = 16;
  if (field.upperBound) id = boundedString;
  if (field.arrayLength) id += 48;
  else if (field.isArray) id += 144;
  return (
    `{"type_id": ${id}, "capacity": ${field.arrayLength ?? 0}, ` +
    `"string_capacity": ${field.upperBound ?? 0}, ` +
    `"nested_type_name": "${nested ? fullName(field.type) : ""}"}`
  );
}

function described(name, fields) {
  const texts = fields.map(
    (field) => `{"name": "${field.name}", "type": ${describedType(name, field)}}`,
  );
  return `{"type_name": "${name}", "fields": [${texts.join(", ")}]}`;
}

/** RIHS01 of a message: SHA-256 over its type description. */
export function hashOf(name) {
  const [[, own], ...others] = definitionsOf(name);
  const referenced = others.sort(([a], [b]) => (a < b ? -1 : 1)).map(([n, f]) => described(n, f));
  const text =
    `{"type_description": ${described(name, own)}, ` +
    `"referenced_type_descriptions": [${referenced.join(", ")}]}`;
  return "RIHS01_" + createHash("sha256").update(text).digest("hex");
}

/** Names and types of all fields, in order, as `pose.position.x float64`. */
export function layoutOf(name, distribution) {
  const lines = [];
  for (const [type, fields] of definitionsOf(name, distribution)) {
    for (const f of fields) lines.push(`${type}.${f.name} ${f.type} ${f.isArray} ${f.arrayLength}`);
  }
  return lines.sort();
}

export const distributions = { ros2jazzy, ros2humble };

/** A decoder of a message's CDR bytes. */
export function readerOf(name) {
  const definitions = [...definitionsOf(name)].map(([type, fields]) => ({
    name: type,
    definitions: fields.map((field) => ({
      ...field,
      type: fullName(field.type),
      isComplex: fullName(field.type).includes("/"),
    })),
  }));
  definitions[0] = { definitions: definitions[0].definitions };
  return new MessageReader(definitions);
}
