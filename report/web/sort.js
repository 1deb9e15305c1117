/* SPDX-FileCopyrightText: 2026 the Stucco authors
   SPDX-License-Identifier: GPL-3.0-or-later */
"use strict";
// A table whose heads are buttons of the class "sort" is sorted by the column that is pressed.
(() => {
  // What a cell sorts by: its number, else its text; a number that is not known comes last.
  function keyOf(row, column) {
    const cell = row.cells[column];
    if (!("sort" in cell.dataset)) return cell.textContent.trim();
    return cell.dataset.sort === "" ? null : Number(cell.dataset.sort);
  }

  const collator = new Intl.Collator("en", {numeric: true});
  function compare(a, b, sign) {
    if (a === null || b === null) return (a === null) - (b === null);
    return sign * (typeof a === "number" ? a - b : collator.compare(a, b));
  }

  function sortBy(header) {
    const ascending = header.getAttribute("aria-sort") !== "ascending";
    for (const other of header.parentElement.cells) other.removeAttribute("aria-sort");
    header.setAttribute("aria-sort", ascending ? "ascending" : "descending");
    const body = header.closest("table").tBodies[0];
    const keyed = Array.from(body.rows, (row) => ({row, key: keyOf(row, header.cellIndex)}));
    keyed.sort((a, b) => compare(a.key, b.key, ascending ? 1 : -1));
    body.append(...keyed.map((entry) => entry.row));
  }

  for (const button of document.querySelectorAll("table .sort")) {
    button.addEventListener("click", () => sortBy(button.closest("th")));
  }
})();
