"use strict";
// Tables sort by the column whose heading is pressed: ascending, then descending; empty cells stay last.
const number = (text) => parseFloat(text.replace("\u2212", "-"));
for (const head of document.querySelectorAll("thead th")) {
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
// The table of contents is folded on a narrow screen and folds again when a link is followed; what a link leads to opens.
const contents = document.querySelector("#contents details");
const wide = window.matchMedia("(min-width: 1180px)");
const fold = () => { contents.open = wide.matches; };
wide.addEventListener("change", fold);
fold();
contents.addEventListener("click", (event) => {
  if (!event.target.matches("a")) return;
  if (!wide.matches) contents.open = false;
  const target = document.querySelector(event.target.getAttribute("href"));
  const first = target.matches("h3") && target.parentNode.querySelector(`#${target.id} ~ .machines details`);
  if (first) first.open = true;
});
// Printed is everything.
window.addEventListener("beforeprint", () => {
  for (const details of document.querySelectorAll("main details")) details.open = true;
});
