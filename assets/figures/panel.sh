#!/bin/sh
# Makes panel.png, the end of scenes/tour/first_light.toml in the panel on a display of its own, and
# panel_contact.png and panel_node.png, one of its contacts and the forces on a node opened there.
# Needs xvfb, xdotool and imagemagick, which makes the files small: 255 colours.
#   assets/figures/panel.sh [PROGRAM [RUN]]
set -e
cd "$(dirname "$0")/../.."
program=${1:-build/spheroscope}
run=${2:-out/first_light/run.h5}
[ -f "$run" ] || "$program" run scenes/tour/first_light.toml -o "$(dirname "$run")"
folder=$(mktemp -d)
Xvfb -displayfd 3 -screen 0 1760x1060x24 -nolisten tcp 3>"$folder/display" 2>"$folder/server.log" &
server=$!
trap 'kill $server; rm -r "$folder"' EXIT
until [ -s "$folder/display" ]; do sleep 0.1; done
DISPLAY=:$(cat "$folder/display")
export DISPLAY
"$program" view "$run" -o "$folder" --json >"$folder/report.json" 2>>"$folder/log" &
panel=$!
until_log() { until grep -q "$1" "$folder/log"; do kill -0 $panel && sleep 0.1; done; }
until_log 'first picture'
until_log 'was read after'
xdotool mousemove 300 950 key End
sleep 2 # for the picture of the last frame
xdotool mousemove 466 391 click 1
until_log picked
xdotool mousemove 300 950
sleep 1 # for the ring and the table
save() {
	xdotool key shift+p
	until_log 'written to'
	convert "$folder/panel.png" -strip -dither FloydSteinberg -colors 255 "assets/figures/$1.png"
	: >"$folder/log" # for the next picture
}
save panel
for x in $(seq 380 15 700); do # until a face is met that another cell touches
	xdotool mousemove "$x" 391 click 1
	sleep 0.5
	grep -q 'contact with' "$folder/log" && break
done
xdotool key o mousemove 300 950
sleep 8 # for its history and the sheet
save panel_contact
xdotool key f
sleep 3 # for the forces of all cells
save panel_node
xdotool key ctrl+q
wait $panel
cat "$folder/report.json"
