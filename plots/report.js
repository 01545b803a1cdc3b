"use strict";
// Tables sort by the column whose heading is pressed: ascending, then descending; empty cells stay last.
for (const head of document.querySelectorAll("th[aria-sort]")) {
  head.querySelector("button").addEventListener("click", () => {
    const up = head.getAttribute("aria-sort") !== "ascending";
    for (const other of head.parentNode.children) other.setAttribute("aria-sort", "none");
    head.setAttribute("aria-sort", up ? "ascending" : "descending");
    const at = head.cellIndex, number = head.classList.contains("number");
    const body = head.closest("table").tBodies[0];
    const keyed = [...body.rows].map((row) => {
      const text = row.cells[at].textContent.trim();
      return { row, text, value: number ? parseFloat(text.replace("\u2212", "-")) : text };
    });
    const last = (item) => item.text === "" || (number && Number.isNaN(item.value));
    keyed.sort((a, b) => last(a) - last(b) || (last(a) ? 0 : (up ? 1 : -1) *
      (number ? a.value - b.value : a.text.localeCompare(b.text, "en", { numeric: true }))));
    body.append(...keyed.map((item) => item.row));
  });
}
// The table of contents is folded on a narrow screen and folds again when a link is followed.
const contents = document.querySelector("#contents details");
const wide = window.matchMedia("(min-width: 1180px)");
const fold = () => { contents.open = wide.matches; };
wide.addEventListener("change", fold);
fold();
contents.addEventListener("click", (event) => {
  if (event.target.matches("a") && !wide.matches) contents.open = false;
});
