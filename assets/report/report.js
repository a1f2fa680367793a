// Slider and blink. Everything else on the page works without scripts.
for (const section of document.querySelectorAll("section")) {
  const a = section.querySelector("img.a");
  const b = section.querySelector("img.b");
  const stage = section.querySelector(".stage");
  if (!a || !b || !stage) continue;
  stage.hidden = false;
  const both = stage.querySelector(".both");
  const below = new Image();
  const above = new Image();
  below.src = a.src;
  above.src = b.src;
  below.alt = "A";
  above.alt = "B";
  above.className = "top";
  both.append(below, above);
  const slider = stage.querySelector("input");
  const blink = stage.querySelector("button");
  const label = stage.querySelector("output");
  let timer = 0;
  const slide = () => {
    above.style.visibility = "visible";
    above.style.clipPath = `inset(0 0 0 ${slider.value}%)`;
    label.textContent = "A left, B right";
  };
  const stop = () => {
    clearInterval(timer);
    timer = 0;
    blink.textContent = "Blink";
    slide();
  };
  slider.addEventListener("input", stop);
  blink.addEventListener("click", () => {
    if (timer) return stop();
    above.style.clipPath = "none";
    blink.textContent = "Stop";
    let shown = true;
    const flip = () => {
      shown = !shown;
      above.style.visibility = shown ? "visible" : "hidden";
      label.textContent = shown ? "B" : "A";
    };
    flip();
    timer = setInterval(flip, 500);
  });
  slide();
}
