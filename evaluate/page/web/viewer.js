/* SPDX-FileCopyrightText: 2026 the Stucco authors
   SPDX-License-Identifier: GPL-3.0-or-later */
"use strict";
// Pictures of a row open large and side by side; without a script the links open one at a time.
(() => {
  const viewer = document.getElementById("viewer");
  const pictures = viewer.querySelector(".side-by-side");

  function open(triple) {
    viewer.querySelector("h3").textContent = triple.dataset.name;
    pictures.replaceChildren(...Array.from(triple.children, (figure) => figure.cloneNode(true)));
    viewer.showModal();
  }

  for (const triple of document.querySelectorAll("td .side-by-side")) {
    triple.addEventListener("click", (event) => {
      if (event.ctrlKey || event.metaKey || event.shiftKey) return;
      event.preventDefault();
      open(triple);
    });
  }
  viewer.querySelector("button").addEventListener("click", () => viewer.close());
  viewer.addEventListener("click", (event) => {
    if (event.target === viewer) viewer.close();
  });
})();
