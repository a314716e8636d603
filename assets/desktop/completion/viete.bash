# viete(1) in bash, on the functions of bash-completion. tests/consumer/completion.sh compares it with the program's own --help.

_viete_meshes='@(obj|ply|off|stl|glb|gltf)'
_viete_caches='@(obj|ply|off|stl|glb|gltf|pc2|mdd)'

# Completes the value of option $prev of command $1; fails where that takes none.
_viete_value() {
  local words=
  case $prev in
    --pose | --model | --cage | --rest | --examples) _filedir "$_viete_meshes" ;;
    --keys) _filedir ;;
    --published) _filedir -d ;;
    --camera) _filedir viete ;;
    --json) _filedir json ;;
    --plot) _filedir svg ;;
    -o | --output)
      case $1 in
        render) _filedir '@(png|svg|pfm)' ;;
        report) _filedir -d ;;
        animate) _filedir '@(pc2|mdd|glb|gltf|obj|ply|off|stl|png|mp4|webm|mkv|gif)' ;;
        between) _filedir "$_viete_caches" ;;
        deform | mix | pose | cage) _filedir "$_viete_meshes" ;;
        *) _filedir ;;
      esac
      ;;
    --method) words='fast diag sd improved_sd' ;;
    --weights) words='inverse cutoff harmonic biharmonic mean-value' ;;
    --blend) words='srl mls-affine mls-similarity mls-rigid linear' ;;
    --way) words='smooth paper mean-value rigid arap local' ;;
    --radius) words='5 10 25 50' ;;
    --turn | --stretch) words='0 50 100 200' ;;
    --look) words='home front back left right top bottom' ;;
    --map) words='none displacement area larger-stretch smaller-stretch shear turn energy volume gap exp-error frame-error influence opening difference signed-difference' ;;
    --compare) words='smooth paper mean-value rigid arap local diag sd improved_sd fast log straight' ;;
    --shading) words='clay porcelain jade file checker normals zebra' ;;
    --pass) words='none depth normals triangles occlusion' ;;
    --size) words='1280x800 1920x1080 3840x2160' ;;
    --kind) words='automatic box hull' ;;
    --symmetry) words='auto none x y z' ;;
    --triangles) words='60 200 600' ;;
    --margin | --gap) words='0.15 0.5 2' ;;
    --cells) words='1x1x1 2x2x2 3x3x3' ;;
    --shape) _filedir "$_viete_caches" ;;
    --scale | --line-width | --frames | --at | --step | --rate | --iterations | --pins | --hold | --tolerance | --largest | --count | --faces | --rounds) ;;
    *) return 1 ;;
  esac
  [[ -z $words ]] || COMPREPLY=($(compgen -W "$words" -- "$cur"))
}

_viete_options() {
  local options=--help
  case $1 in
    '' | view)
      options+=' --pose --model --cage --method --way --weights --blend --radius --turn --stretch --stitched --iterations --pins --hold --scale --frames'
      [[ $1 ]] || options+=' --version'
      ;;
    render)
      options+=' --output --force --pose --model --cage --size --scale --method --way --weights --blend --radius --turn --stretch --stitched --iterations --pins --hold --look --camera --shading --map --compare --panels --light --wireframe
        --transparent --pass --line-width --error-map --show-cage --no-grid'
      ;;
    deform) options+=' --output --digits --force --pose --model --cage --mask --stream --method --way --weights --blend --radius --turn --stretch --stitched --iterations --pins --hold' ;;
    animate)
      options+=' --output --force --model --cage --keys --frames --step --rate --tolerance --no-normals --largest --straight --turntable --digits --method --way --weights --blend --radius --turn --stretch --stitched --iterations --pins --hold
        --size --scale --line-width --look --camera --shading --map --compare --panels --light --wireframe --error-map --show-cage --no-grid'
      ;;
    between) options+=' --output --frames --at --rest --loop --linear --straight --rate --digits --force' ;;
    mix) options+=' --output --shape --straight --digits --force' ;;
    pose) options+=' --output --examples --pin --pull --firmness --freedom --restraint --digits --force' ;;
    cage) options+=' --output --force --kind --triangles --margin --gap --symmetry --quads --cells --own-axes' ;;
    info) options+=' --cage' ;;
    report) options+=' --output --quick --force' ;;
    'bench exp') options+=' --force --count --json --float --plot' ;;
    'bench eigen') options+=' --force --count --json --plot' ;;
    'bench accuracy') options+=' --force --count --json --float' ;;
    'bench sym3') options+=' --force --count --json' ;;
    'bench frame') options+=' --force --count --faces --rounds --tolerance --json' ;;
    'bench bind') options+=' --force --count --faces --rounds --json' ;;
    'bench modes') options+=' --force --method --weights --blend --radius --stitched --iterations --pins --hold --rounds --json' ;;
    'bench cage') options+=' --force --json' ;;
    'bench files') options+=' --force --rounds --json' ;;
    'bench stitched' | 'bench time') options+=' --force --rounds --json' ;;
    'bench shapes') options+=' --force --rounds --published --json' ;;
  esac
  COMPREPLY=($(compgen -W "$options" -- "$cur"))
}

_viete() {
  local cur prev words cword split
  _init_completion -s || return

  local commands='view render deform animate between mix pose cage info manual bench report help' benches='exp eigen accuracy sym3 frame bind files cage modes stitched time shapes'
  local command=${words[1]}
  [[ $cword -gt 1 && " $commands " == *" $command "* ]] || command=
  [[ $command == bench && $cword -gt 2 && " $benches " == *" ${words[2]} "* ]] && command+=" ${words[2]}"

  _viete_value "$command" && return
  [[ $split != true ]] || return
  case $cur:$command in
    -*) _viete_options "$command" ;;
    *:bench) COMPREPLY=($(compgen -W "$benches" -- "$cur")) ;;
    *:bench\ frame | *:bench\ bind | *:bench\ files | *:bench\ cage | *:bench\ modes | *:bench\ stitched | *:bench\ shapes) _filedir "$_viete_meshes" ;;
    *:bench\ time) _filedir viete ;;
    *:bench\ *) ;;
    *:manual) COMPREPLY=($(compgen -W 'window cages blending time shapes files command_line python blender cpp figures' -- "$cur")) ;;
    *:between) _filedir "$_viete_caches" ;;
    *:info | *:cage | *:mix | *:pose | *:report) _filedir "$_viete_meshes" ;;
    *)
      _filedir '@(obj|ply|off|stl|glb|gltf|viete)'
      [[ $cword -gt 1 ]] || COMPREPLY+=($(compgen -W "$commands" -- "$cur"))
      ;;
  esac
}

complete -F _viete viete
