// Sets the formulas, and folds the contents away where the screen is narrow.
document.addEventListener("DOMContentLoaded", () => {
  if (window.katex)
    for (const element of document.querySelectorAll(".formula")) {
      const display = element.classList.contains("display");
      katex.render(element.textContent, element, {displayMode: display, throwOnError: false});
    }
  const contents = document.querySelector(".site-contents details");
  if (contents && window.innerWidth < 1000) contents.open = false;
});
