// Sets the formulas, gives listings a button that copies them, and folds the contents away where the screen is narrow.
document.addEventListener("DOMContentLoaded", () => {
  if (window.katex)
    for (const element of document.querySelectorAll(".formula")) {
      const display = element.classList.contains("display");
      katex.render(element.textContent, element, {displayMode: display, throwOnError: false});
    }
  for (const listing of document.querySelectorAll(".highlight")) addCopyButton(listing);
  const contents = document.querySelector(".site-contents details");
  if (contents && window.innerWidth < 1000) contents.open = false;
});

// From a listing with output only the commands are copied.
function textToCopy(listing) {
  const text = listing.querySelector("pre").textContent.replace(/\n$/, "");
  if (!listing.closest(".console")) return text;
  return text.split("\n").filter((line) => line.startsWith("$ ")).map((line) => line.slice(2)).join("\n");
}

function addCopyButton(listing) {
  const button = document.createElement("button");
  button.className = "copy";
  button.type = "button";
  button.textContent = "Copy";
  button.setAttribute("aria-live", "polite");
  button.addEventListener("click", async () => {
    try {
      await navigator.clipboard.writeText(textToCopy(listing));
      button.textContent = "Copied";
    } catch {
      getSelection().selectAllChildren(listing.querySelector("pre"));
      button.textContent = "Selected";
    }
    setTimeout(() => { button.textContent = "Copy"; }, 2000);
  });
  listing.append(button);
}
