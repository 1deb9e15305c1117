/* SPDX-FileCopyrightText: 2026 the Stucco authors
   SPDX-License-Identifier: GPL-3.0-or-later */
"use strict";
// The facade table: filters by verdict, surface and text.
(() => {
  const table = document.getElementById("facade-table");
  if (!table) return;
  const rows = Array.from(table.tBodies[0].rows);
  const tiles = Array.from(document.querySelectorAll(".tile"));
  const search = document.getElementById("search");
  const surfaces = document.getElementById("class-filter");
  const shown = document.getElementById("shown");
  const noneShown = document.getElementById("none-shown");
  let verdict = "";

  function isOfSurface(row) {
    return !surfaces || surfaces.value === "" || row.dataset.class === surfaces.value;
  }

  function filter() {
    const wanted = search.value.trim().toLowerCase();
    let count = 0;
    for (const row of rows) {
      const matches = isOfSurface(row) && (verdict === "" || row.dataset.verdict === verdict) &&
        row.querySelector("th").textContent.toLowerCase().includes(wanted);
      row.hidden = !matches;
      if (matches) count += 1;
    }
    shown.textContent = count + " of " + rows.length + " shown";
    noneShown.hidden = count > 0;
    for (const tile of tiles) {
      const own = rows.filter((row) => isOfSurface(row) && row.dataset.verdict === tile.dataset.verdict);
      tile.querySelector(".tile-count").textContent = own.length;
      tile.setAttribute("aria-pressed", String(tile.dataset.verdict === verdict));
    }
  }

  for (const tile of tiles) {
    tile.addEventListener("click", () => {
      verdict = verdict === tile.dataset.verdict ? "" : tile.dataset.verdict;
      filter();
      table.scrollIntoView({block: "nearest"});
    });
  }
  search.addEventListener("input", filter);
  if (surfaces) surfaces.addEventListener("change", filter);
  document.getElementById("show-all").addEventListener("click", () => {
    verdict = "";
    search.value = "";
    if (surfaces) surfaces.value = "";
    filter();
  });
  filter();
})();
