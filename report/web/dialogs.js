/* SPDX-FileCopyrightText: 2026 the Stucco authors
   SPDX-License-Identifier: GPL-3.0-or-later */
// A facade's details: opened from the table, the map and the list of the worst; arrow keys step
// through the facades that the table shows, in its order.
(() => {
  const dialogOf = (index) => document.getElementById("facade-" + index);

  function open(index) {
    const dialog = dialogOf(index);
    if (!dialog) return;
    for (const other of document.querySelectorAll("dialog[open]")) other.close();
    dialog.showModal();
    dialog.scrollTop = 0;
    history.replaceState(null, "", "#facade-" + index);
  }

  function step(from, by) {
    const shown = Array.from(document.querySelectorAll("#facade-table tbody tr"))
      .filter((row) => !row.hidden).map((row) => row.dataset.index);
    if (shown.length === 0) return;
    const at = shown.indexOf(from);
    open(shown[at < 0 ? 0 : (at + by + shown.length) % shown.length]);
  }

  document.addEventListener("click", (event) => {
    const opener = event.target.closest("[data-open]");
    if (opener) return open(opener.dataset.open);
    const dialog = event.target.closest("dialog.facade");
    const row = event.target.closest("#facade-table tbody tr");
    if (row) return open(row.dataset.index);
    if (!dialog) return undefined;
    const stepper = event.target.closest("[data-step]");
    if (stepper) return step(dialog.id.slice("facade-".length), Number(stepper.dataset.step));
    // A click on the dialog itself is one on the backdrop: its content covers the rest.
    if (event.target === dialog || event.target.closest("[data-close]")) dialog.close();
    return undefined;
  });

  document.addEventListener("keydown", (event) => {
    const dialog = document.querySelector("dialog[open]");
    if (!dialog || event.target.matches("input")) return;
    if (event.key === "ArrowLeft") step(dialog.id.slice("facade-".length), -1);
    if (event.key === "ArrowRight") step(dialog.id.slice("facade-".length), 1);
  });

  for (const dialog of document.querySelectorAll("dialog.facade")) {
    dialog.addEventListener("close", () => {
      if (location.hash === "#" + dialog.id) history.replaceState(null, "", location.href.split("#")[0]);
    });
    const blend = dialog.querySelector(".blend");
    const stack = dialog.querySelector(".stack");
    if (blend) {
      blend.addEventListener("input", () => stack.style.setProperty("--blend", blend.value / 100));
    }
  }
  const linked = /^#facade-(\d+)$/.exec(location.hash);
  if (linked) open(linked[1]);
})();
