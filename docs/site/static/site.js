// SPDX-License-Identifier: MIT
// The button that changes between light, dark and what the system prefers. The theme's own script does
// that, too, but as Debian ships it no browser loads it.
document.addEventListener("DOMContentLoaded", () => {
  document.documentElement.classList.remove("no-js");
  const order = matchMedia("(prefers-color-scheme: dark)").matches
    ? ["auto", "light", "dark"]
    : ["auto", "dark", "light"];
  for (const button of document.getElementsByClassName("theme-toggle")) {
    button.addEventListener("click", () => {
      const next = order[(order.indexOf(document.body.dataset.theme) + 1) % 3];
      document.body.dataset.theme = next;
      localStorage.setItem("theme", next);
    });
  }
});
