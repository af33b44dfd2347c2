// SPDX-License-Identifier: Apache-2.0
// Makes each page one file: node build.mjs PAGE BENCH_PAGE. Script and style stand in it, and its
// policy allows these two by their hashes, so nothing else runs on it, whatever a recording holds.
import { createHash } from "node:crypto";
import { readFileSync, writeFileSync } from "node:fs";

import { build } from "esbuild";

const hash = (text) => `'sha256-${createHash("sha256").update(text).digest("base64")}'`;

async function make_page(entry, frame, output) {
  const made = await build({
    entryPoints: [entry],
    bundle: true,
    minify: true,
    write: false,
    outdir: "out",
    target: "es2022",
    format: "iife",
    legalComments: "none",
    loader: { ".css": "css" },
  });
  const text_of = (ending) => made.outputFiles.find((file) => file.path.endsWith(ending)).text.trim();
  // A script ends at the first such tag, also inside a text.
  const script = text_of(".js").replaceAll("</script", "<\\/script").replaceAll("<!--", "<\\!--");
  const style = text_of(".css");
  const policy = [
    "default-src 'none'",
    `script-src ${hash(script)}`,
    `style-src ${hash(style)}`,
    "img-src data: blob:",
    "connect-src 'self'",
    "base-uri 'none'",
    "form-action 'none'",
  ].join("; ");
  // Functions, since a text with a dollar sign would be read as a pattern.
  const page = readFileSync(frame, "utf8")
    .replace("@POLICY@", () => policy)
    .replace("@STYLE@", () => style)
    .replace("@SCRIPT@", () => script);
  writeFileSync(output, page);
}

await make_page("src/main.ts", "src/index.html", process.argv[2] ?? "page.html");
await make_page("src/bench/main.ts", "src/bench/index.html", process.argv[3] ?? "bench_page.html");
