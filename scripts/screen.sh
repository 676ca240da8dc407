# A screen that nobody sees and pictures of it, for scripts that source this after common.sh.

# Starts a screen of the size of the windows in rviz/; sets `screen` and `screen_process`.
start_screen() {
  local number ready
  exec {ready}< <(exec Xvfb -displayfd 1 -screen 0 1280x800x24 -nolisten tcp 2>/dev/null)
  screen_process=$!
  read -r -t 30 number <&"$ready" || { echo "the virtual display did not start" >&2; return 1; }
  screen=:$number
}

# take_picture FILE: what the screen shows.
take_picture() {
  DISPLAY=$screen xwd -root -silent 2>/dev/null | convert xwd:- "$1" 2>/dev/null
}

# shows FILE R,G,B:N...: whether a picture has more than N pixels of about each colour where rviz draws the scene.
shows() {
  local picture=$1
  shift
  convert "$picture" -crop 860x640+400+110 -depth 8 -format %c histogram:info:- | awk -F'[(),]' -v wanted="$*" '
    BEGIN { n = split(wanted, colour, " ")
            for (i = 1; i <= n; ++i) { split(colour[i], part, /[,:]/); red[i] = part[1]; green[i] = part[2]
                                       blue[i] = part[3]; least[i] = part[4] } }
    { for (i = 1; i <= n; ++i)
        if (($2 - red[i])^2 + ($3 - green[i])^2 + ($4 - blue[i])^2 < 400) count[i] += $1 }
    END { for (i = 1; i <= n; ++i) if (count[i] <= least[i]) exit 1 }'
}
