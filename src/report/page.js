"use strict";
// Pictures that take each other's place: a click shows the next one, the wheel zooms about the pointer, a drag moves; the view stays the
// same for all of them.
for (const viewer of document.querySelectorAll(".viewer")) {
    const stage = viewer.querySelector(".stage");
    const moved = viewer.querySelector(".moved");
    const layers = [...viewer.querySelectorAll(".layer")];
    const picks = [...viewer.querySelectorAll(".pick")];
    let shown = 0;
    let view = { x: 0, y: 0, zoom: 1 };
    let drag = null;

    function show(number) {
        shown = (number + layers.length) % layers.length;
        layers.forEach((layer, i) => layer.classList.toggle("on", i === shown));
        picks.forEach((pick, i) => pick.classList.toggle("on", i === shown));
    }

    function place() {
        const least = (side) => side * (1 - view.zoom);
        view.x = Math.min(0, Math.max(least(stage.clientWidth), view.x));
        view.y = Math.min(0, Math.max(least(stage.clientHeight), view.y));
        moved.style.transform = `translate(${view.x}px, ${view.y}px) scale(${view.zoom})`;
    }

    picks.forEach((pick, i) => pick.addEventListener("click", () => show(i)));
    stage.addEventListener("wheel", (event) => {
        event.preventDefault();
        const box = stage.getBoundingClientRect();
        const [px, py] = [event.clientX - box.left, event.clientY - box.top];
        const zoom = Math.min(64, Math.max(1, view.zoom * Math.pow(2, -event.deltaY / 240)));
        const ratio = zoom / view.zoom;
        view = { x: px - (px - view.x) * ratio, y: py - (py - view.y) * ratio, zoom };
        place();
    }, { passive: false });
    stage.addEventListener("pointerdown", (event) => {
        drag = { x: event.clientX, y: event.clientY, from: { ...view }, far: false };
        stage.setPointerCapture(event.pointerId);
    });
    stage.addEventListener("pointermove", (event) => {
        if (!drag) {
            return;
        }
        const [dx, dy] = [event.clientX - drag.x, event.clientY - drag.y];
        drag.far = drag.far || Math.hypot(dx, dy) > 3;
        if (drag.far) {
            view = { ...view, x: drag.from.x + dx, y: drag.from.y + dy };
            place();
        }
    });
    stage.addEventListener("pointerup", () => {
        if (drag && !drag.far) {
            show(shown + 1);
        }
        drag = null;
    });
    viewer.querySelector(".whole").addEventListener("click", () => {
        view = { x: 0, y: 0, zoom: 1 };
        place();
    });
}
