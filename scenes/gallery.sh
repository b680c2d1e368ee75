#!/bin/sh
# Renders every material of scenes/materials/showcase.ron, and every shipped scene, with the program, and puts
# the pictures on two sheets.
#
#   scenes/gallery.sh [FOLDER] [SPP] [CHAINLIGHT OPTIONS...]
#
# FOLDER (target/gallery) gets materials.png, scenes.png and the single pictures; SPP (64) is samples per pixel.
# Further options go to every `chainlight render`, such as `--threads 1`.
set -eu
cd "$(dirname "$0")/.."
folder=${1:-target/gallery}
spp=${2:-64}
[ $# -le 2 ] && set -- || shift 2
mkdir -p "$folder/materials" "$folder/scenes"
cargo build --release --quiet --bin chainlight --example contact_sheet
target=${CARGO_TARGET_DIR:-target}/release

# Not materials of the subject, but of what stands around it.
around='tiles|wall|grey|stand|lamp'
showcase=scenes/materials/showcase.ron
materials=$(sed -n '/materials: {/,/^    }/s/^        "\([^"]*\)".*/\1/p' "$showcase" | grep -vxE "$around" | tr ' ' '-')

for material in $materials; do
    name=$(echo "$material" | tr '-' ' ')
    scene=scenes/materials/.$material.ron
    # Beside the template, so that the files it names are found.
    sed "s|material: \"[^\"]*\", // the subject|material: \"$name\",|" "$showcase" > "$scene"
    "$target/chainlight" render "$scene" --spp "$spp" -o "$folder/materials/$material.exr" "$@" || { rm "$scene"; exit 1; }
    rm "$scene"
done
"$target/examples/contact_sheet" "$folder/materials.png" 4 256 $(printf "$folder/materials/%s.png " $materials)

for scene in scenes/*.ron; do
    name=$(basename "$scene" .ron)
    # Most of the light of these is easier to find from both ends.
    case $name in
        door-ajar | glass-egg | cornell-glass | cornell-window) technique="--technique bdpt" ;;
        *) technique= ;;
    esac
    # shellcheck disable=SC2086 # one word or none
    "$target/chainlight" render "$scene" --spp "$spp" $technique -o "$folder/scenes/$name.exr" "$@"
done
"$target/examples/contact_sheet" "$folder/scenes.png" 4 320 "$folder"/scenes/*.png
echo "$folder/materials.png, $folder/scenes.png"
