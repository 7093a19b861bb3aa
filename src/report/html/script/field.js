// The stress pictures: which one is seen, and the value under the pointer, read from its palette.
function makeField(figure) {
  const pictures = [...figure.querySelectorAll(".picture")];
  const choice = figure.querySelector("select"), said = figure.querySelector("output");
  const lines = figure.querySelector("input[type=checkbox]");
  const palette = new Map(JSON.parse(figure.dataset.palette).map((rgb, i) => [rgb, i]));
  const caption = figure.querySelector("figcaption"), end = figure.querySelector(".scale .end");
  const shown = () => pictures[Number(choice.value)];
  let pixels = null;

  function read() {
    const image = shown().querySelector("img");
    const canvas = document.createElement("canvas");
    canvas.width = image.naturalWidth;
    canvas.height = image.naturalHeight;
    if (!canvas.width) return;
    const context = canvas.getContext("2d", { willReadFrequently: true });
    context.drawImage(image, 0, 0);
    pixels = context.getImageData(0, 0, canvas.width, canvas.height);
  }

  choice.addEventListener("change", () => {
    pictures.forEach((picture) => { picture.hidden = picture !== shown(); });
    caption.textContent = `${figure.dataset.title}: ${choice.selectedOptions[0].textContent}`;
    end.textContent = shown().dataset.end;
    said.textContent = "";
    pixels = null;
  });
  if (lines) lines.addEventListener("change", () => figure.classList.toggle("bare", !lines.checked));
  for (const picture of pictures) {
    picture.addEventListener("pointermove", (event) => {
      if (!pixels) read();
      if (!pixels) return;
      const box = picture.getBoundingClientRect();
      const x = Math.floor((event.clientX - box.left) / box.width * pixels.width);
      const y = Math.floor((event.clientY - box.top) / box.height * pixels.height);
      const at = 4 * (y * pixels.width + x), [r, g, b] = pixels.data.slice(at, at + 3);
      const level = palette.get((r << 16) | (g << 8) | b);
      said.textContent = level === undefined || pixels.data[at + 3] === 0 ? "" : `${level === 254 ? "\u2265 " : ""}${significant(level / 254 * Number(shown().dataset.highest), 3)} MPa`;
    });
    picture.addEventListener("pointerleave", () => { said.textContent = ""; });
  }
}
