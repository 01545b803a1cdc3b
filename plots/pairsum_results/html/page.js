"use strict";
// Case and threads: of what belongs to one of them, the chosen one is shown. Without this script all of it is.
const bar = document.getElementById("bar");
for (const [key, label] of [["threads", "Threads"], ["case", "Case"]]) {
  const parts = [...document.querySelectorAll(`main [data-${key}]`)];
  const values = [...new Set(parts.map((part) => part.dataset[key]))];
  if (values.length < 2) continue;
  const select = document.createElement("select");
  select.append(...values.map((value) => new Option(value)));
  const show = () => { for (const part of parts) part.classList.toggle(`other-${key}`, part.dataset[key] !== select.value); };
  select.value = values.includes(bar.dataset[key]) ? bar.dataset[key] : values[0];
  select.name = key;
  select.addEventListener("change", show);
  show();
  const named = document.createElement("label");
  named.append(label, " ", select);
  bar.prepend(named);
}
// The command can be copied.
for (const command of document.querySelectorAll(".command")) {
  const button = document.createElement("button");
  button.type = "button";
  button.textContent = "Copy";
  button.addEventListener("click", () => {
    getSelection().selectAllChildren(command.querySelector("code"));
    button.textContent = document.execCommand("copy") ? "Copied" : "Press Ctrl+C";
  });
  command.append(button);
}
// Tables sort by the column whose heading is pressed: ascending, then descending; empty cells stay last.
const number = (text) => parseFloat(text.replace("\u2212", "-")) * ({ k: 1e3, M: 1e6, G: 1e9 }[text.slice(-1)] || 1);
for (const head of document.querySelectorAll("#tables thead th")) {
  const button = document.createElement("button");
  button.type = "button";
  button.append(...head.childNodes);
  head.append(button);
  head.setAttribute("aria-sort", "none");
  button.addEventListener("click", () => {
    const up = head.getAttribute("aria-sort") !== "ascending";
    for (const other of head.parentNode.children) other.setAttribute("aria-sort", "none");
    head.setAttribute("aria-sort", up ? "ascending" : "descending");
    const body = head.closest("table").tBodies[0];
    const keyed = [...body.rows].map((row) => ({ row, text: row.cells[head.cellIndex].textContent.trim() }));
    const empty = (item) => item.text === "" || item.text === "-";
    const numeric = keyed.every((item) => empty(item) || !Number.isNaN(number(item.text)));
    keyed.sort((a, b) => empty(a) - empty(b) || (empty(a) ? 0 : (up ? 1 : -1) * (numeric
      ? number(a.text) - number(b.text) : a.text.localeCompare(b.text, "en", { numeric: true }))));
    body.append(...keyed.map((item) => item.row));
  });
}
// Printed is everything.
window.addEventListener("beforeprint", () => {
  for (const details of document.querySelectorAll("main details")) details.open = true;
});
