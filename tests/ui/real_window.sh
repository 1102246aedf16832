#!/usr/bin/env bash
# The real window under Xvfb: opens a job, runs it by a key, keeps a picture, is closed by a key. Exit 77: skipped.
# real_window.sh ADIT ADIT-GUI PICTURE_FOLDER
set -euo pipefail
adit=$1 gui=$2 pictures=$3

say() { printf 'real_window: %s\n' "$*"; }
for tool in xvfb-run xdotool import convert; do
  command -v "$tool" >/dev/null || { say "skipped: $tool is not installed"; exit 77; }
done
if [ -z "${ADIT_UNDER_XVFB:-}" ]; then
  export ADIT_UNDER_XVFB=1 LIBGL_ALWAYS_SOFTWARE=1
  exec xvfb-run -a -s "-screen 0 1440x900x24 +extension GLX" bash "$0" "$@"
fi

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir -p "$pictures"
"$adit" demo "$folder/job" --stations 2 --points 150000 --no-run --quiet >/dev/null

# A busy machine's server may not answer at once.
for ((i = 0; i < 200; ++i)); do xdotool getdisplaygeometry >/dev/null 2>&1 && break; sleep 0.1; done
xdotool getdisplaygeometry >/dev/null 2>&1 || { say "the X server $DISPLAY does not answer"; exit 1; }
"$gui" "$folder/job" & program=$!
trap 'kill "$program" 2>/dev/null || true; rm -rf "$folder"' EXIT

wait_for() {  # WHAT SECONDS COMMAND...
  local what=$1 tenths=$(($2 * 10)); shift 2
  for ((i = 0; i < tenths; ++i)); do
    kill -0 "$program" 2>/dev/null || { say "the program has ended before $what"; exit 1; }
    if "$@" >/dev/null 2>&1; then return 0; fi
    sleep 0.1
  done
  say "$what did not come about"; exit 1
}
colours() { import -window root "$1" && [ "$(convert "$1" -depth 4 -format %k info:)" -ge "$2" ]; }

wait_for "the window" 60 xdotool search --name Adit
window=$(xdotool search --name Adit | head -1)
wait_for "its first picture" 60 colours "$pictures/real_start.png" 5
xdotool mousemove 700 300 windowfocus "$window"
xdotool key F5
wait_for "the report" 300 test -s "$folder/job/out/report.pdf"
sleep 2
wait_for "the scans" 60 colours "$pictures/real_window.png" 20
xdotool windowfocus "$window" key ctrl+q
for ((i = 0; i < 100; ++i)); do kill -0 "$program" 2>/dev/null || break; sleep 0.1; done
kill -0 "$program" 2>/dev/null && { say "the window does not close"; exit 1; }
code=0; wait "$program" || code=$?
[ "$code" -eq 0 ] || { say "closed with exit code $code"; exit 1; }
say "opened, run, seen and closed"
