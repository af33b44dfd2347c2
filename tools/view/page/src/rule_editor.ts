// SPDX-License-Identifier: Apache-2.0
// The rule base of a stage as its file has it, with a field for each number and each word that a
// rule answers: the run goes on from the chosen tick with what was written there.

import { button, element } from "./elements";
import type { Run } from "./run";
import type { Choices, RuleEdit } from "./server";

/// A file that a parameter of the run's graph names.
export interface RuleFile {
  stage: string;
  part: string;
  behaviour: string;
  /// The parameter.
  name: string;
  file: string;
  text: string;
}

/// What is done with these files, in place of those that the graph names: a run that is over is
/// branched from the chosen tick, one under way goes on with them.
export interface RuleUse {
  label: string;
  title: string;
  /// Why they cannot be used now; empty if they can.
  why_not?(): string;
  /// What came of it, and the command line that does the same.
  use(rules: RuleEdit[]): Promise<{ said: string; command: string }>;
}

type Tree = Record<string, unknown>;
const is_tree = (value: unknown): value is Tree => typeof value === "object" && value !== null && !Array.isArray(value);

/// The parameters of a behaviour in an expanded graph: beside its name, or below it.
function parameters_of(stage: Tree, part: string, behaviour: string): Tree | undefined {
  const chosen = stage[part];
  if (chosen === behaviour) return part === "behaviour" ? stage : {};
  for (const each of Array.isArray(chosen) ? chosen : [chosen]) {
    if (each === behaviour) return {};
    if (is_tree(each) && is_tree(each[behaviour])) return each[behaviour];
  }
  return undefined;
}

/// The rule bases that the run's graph names for a stage.
export function rule_files(run: Run, choices: Choices, stage_name: string): RuleFile[] {
  const stage = run.graph[stage_name];
  const known = choices.stages.find(({ name }) => name === stage_name);
  if (!is_tree(stage) || !known) return [];
  const files: RuleFile[] = [];
  for (const part of known.parts) {
    for (const behaviour of part.variants) {
      const values = parameters_of(stage, part.name, behaviour.name);
      for (const { name, folder } of values ? behaviour.parameters : []) {
        const file = values?.[name];
        if (folder !== "rulebases" || typeof file !== "string") continue;
        const text = run.recording.bundle.get(`rulebases/${file}.yaml`);
        if (text !== undefined) files.push({ stage: stage_name, part: part.name, behaviour: behaviour.name, name, file, text });
      }
    }
  }
  return files;
}

/// A line is code and a comment; the format says what the file is.
const kComment = /(^|\s)#.*$/;
/// Numbers, and in brackets words as well.
const kNumber = /-?(?<![\w.])\d+(?:\.\d+)?(?:e-?\d+)?(?![\w.])/gi;
const kNumberOrWord = /-?(?<![\w.])\d+(?:\.\d+)?(?:e-?\d+)?(?![\w.])|[A-Za-z_]+(?![\w]*\s*:)/gi;

export class RuleEditor {
  readonly box: HTMLElement;
  private pieces: (string | HTMLInputElement)[] = [];
  private readonly use_button: HTMLButtonElement;
  private readonly blocked = element("p", { class: "faint" });
  private readonly lines = element("div", { class: "rules" });
  private readonly message = element("p", { class: "warn", role: "alert" });
  private readonly done = element("p", { class: "faint", role: "status" });

  constructor(private readonly of: RuleFile, private readonly use: RuleUse) {
    this.use_button = button(use.label, use.title, () => void this.go());
    this.use_button.className = "strong";
    this.box = element("details", { class: "rule-editor", "data-rules": `${of.stage}.${of.name}` },
      element("summary", {}, `rule base ${of.file}`), this.lines,
      element("div", { class: "row" }, this.use_button, button("As it was", "Take all changes back", () => this.fill())), this.blocked, this.message, this.done);
    this.fill();
    this.refresh();
  }

  /// Whether they can be used may change with the chosen tick.
  refresh(): void {
    const why_not = this.use.why_not?.() ?? "";
    this.use_button.disabled = why_not !== "";
    this.blocked.textContent = why_not;
  }

  /// The file with what was written.
  private get text(): string {
    return this.pieces.map((piece) => typeof piece === "string" ? piece : piece.value).join("");
  }

  private fill(): void {
    this.pieces = [];
    this.lines.replaceChildren(...this.of.text.split("\n").map((line) => this.line(line)));
    this.pieces.pop();
    this.message.textContent = "";
  }

  private line(line: string): HTMLElement {
    const comment = kComment.exec(line);
    const code = comment ? line.slice(0, comment.index) : line;
    const row = element("div");
    const add = (text: string): void => {
      if (text === "") return;
      row.append(text);
      this.pieces.push(text);
    };
    let at = 0;
    for (const { 0: token, index } of code.startsWith("format:") ? [] : code.matchAll(in_brackets(code) ? kNumberOrWord : kNumber)) {
      add(code.slice(at, index));
      const field = element("input", { "aria-label": code.slice(0, index + token.length).trim(), spellcheck: "false" });
      field.value = token;
      field.size = Math.max(2, token.length);
      field.addEventListener("input", () => {
        field.size = Math.max(2, field.value.length);
        field.classList.toggle("changed", field.value !== token);
      });
      row.append(field);
      this.pieces.push(field);
      at = index + token.length;
    }
    add(code.slice(at));
    if (comment) {
      row.append(element("small", {}, line.slice(comment.index)));
      this.pieces.push(line.slice(comment.index));
    }
    this.pieces.push("\n");
    return row;
  }

  private async go(): Promise<void> {
    const { stage, part, behaviour, name } = this.of;
    const text = this.text;
    this.message.textContent = "";
    this.done.replaceChildren();
    try {
      const { said, command } = await this.use.use([{ stage, part, behaviour, name, text }]);
      const save = element("a", { download: `${this.of.file.replaceAll("/", "_")}-edited.yaml`, href: URL.createObjectURL(new Blob([text], { type: "application/yaml" })) },
        "Save the rule base");
      this.done.append(`${said}. The same on the command line, as long as this server runs: `, element("code", {}, command), " ", save, " to keep it.");
    } catch (error) {
      this.message.textContent = error instanceof Error ? error.message : String(error);
    }
  }
}

/// A row of a table, or of a list of rules in words.
function in_brackets(code: string): boolean {
  return /\[[^\]]*[A-Za-z]/.test(code);
}
