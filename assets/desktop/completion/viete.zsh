#compdef viete
# viete(1) in zsh. tests/consumer/completion.sh compares it with the program's own --help.

local any="_files -g '*.(#i)(obj|ply|off|stl|glb|gltf|viete)(-.)'" mesh="_files -g '*.(#i)(obj|ply|off|stl|glb|gltf)(-.)'"
local -a help=('(-h --help)'{-h,--help}'[what it can do]')
local cache="_files -g '*.(#i)(obj|ply|off|stl|glb|gltf|pc2|mdd)(-.)'"
local -a files=("1:model or session:$any" "2:cage:$mesh" "--model=[of the session]:model:$mesh" "--cage=[of the session]:cage:$mesh")
local -a meshes=("1:model:$mesh" "2:cage:$mesh")
local -a force=('--force[replace other files too]')
local -a output=($force '(-o --output)'{-o+,--output=}'[file to write]:file:_files')
local -a pose=("--pose=[posed cage]:pose:$mesh")
local -a method=('--method=[how exp is computed]:method:(fast diag sd improved_sd)')
local -a weighting=('--weights=[how much of each face or vertex of the cage a vertex takes]:weights:(inverse cutoff harmonic biharmonic mean-value)')
local -a blend=('--blend=[what of the maps is summed]:blend:(srl mls-affine mls-similarity mls-rigid linear)')
local -a way=('--way=[how the cage moves the mesh]:way:(smooth paper mean-value rigid arap local)')
local -a limits=('--radius=[where cut-off weights end, percent]:percent:(5 10 25 50)')
local -a amounts=('--turn=[how much of rotations acts, percent]:percent:(0 50 100 200)' '--stretch=[how much of stretches acts, percent]:percent:(0 50 100 200)')
local -a stitched=('--stitched[as rigid as possible]' '--iterations=[how often a stitched mesh is solved for]:iterations:(1 2 3 5)'
  '--pins=[how near to the cage a stitched mesh is pinned]:percent:(0 5 10)' '--hold=[how firmly a stitched mesh is held]:percent:(0 5 20)')
local -a tolerance=('--tolerance=[of compressed weights]:tolerance:')
local -a scale=('--scale=[device pixels per logical pixel]:scale:')
local -a picture=($scale
  '--size=[logical pixels]:size:(1280x800 1920x1080 3840x2160)'
  '--look=[from where]:view:(home front back left right top bottom)'
  '--camera=[seen as that session is]:session:_files -g "*.viete"'
  '--shading=[what the mesh is coloured by]:shading:(clay porcelain jade file checker normals zebra)'
  '--map=[what the mesh is coloured by, as in the Lab]:map:(none displacement area larger-stretch smaller-stretch shear turn energy volume gap exp-error frame-error influence opening difference signed-difference)'
  '--compare=[ways or methods side by side]:words:(smooth paper mean-value rigid arap local diag sd improved_sd fast log straight)'
  '--line-width=[of the cage and of edges, in points]:points:(0.5 0.75 1 2)'
  '--panels[with the panels]' '--light[light theme]' '--wireframe[with the edges of the mesh]'
  '--error-map[with the error as colours]' '--show-cage[with the cage]' '--no-grid[without the grid]')
local -a digits=('--digits=[decimals of what moved in text files]:decimals:(all 4 6 9)')
local -a straight=('--straight[straight lines from key to key, or shape to shape]') rate=('--rate=[frames a second]:rate:')
local -a count=('--count=[matrices or vertices]:count:')
local -a faces=('--faces=[triangles of the cage]:triangles:') rounds=('--rounds=[repetitions]:rounds:')
local -a json=($force "--json=[also write the numbers]:file:_files -g '*.json'")
local -a plot=("--plot=[also draw them]:file:_files -g '*.svg'")
local -a float=('--float[single precision]')

local -a specs=($help)
local command=$words[2]
[[ $command == bench ]] && command="bench $words[3]"
case $command in
  render)
    specs+=($files $output $pose $method $weighting $blend $way $limits $amounts $stitched $picture '--transparent[without a background]'
      '--pass=[what is told of the model instead]:pass:(none depth normals triangles occlusion)')
    ;;
  deform)
    specs+=($files $output $digits $pose $method $weighting $blend $way $limits $amounts $stitched
      '--mask=[how much of its motion each vertex makes]:file:_files' '--stream[poses from standard input, positions to standard output]')
    ;;
  animate)
    specs+=($files $output $method $weighting $blend $way $limits $amounts $stitched $picture $digits
      '--keys=[keys of other files]:file:_files' '--frames=[first-last]:frames:' '--step=[every so many frames]:frames:' $rate $straight
      '--tolerance=[of morph targets]:tolerance:'
      '--no-normals[morph targets of positions alone]' '--largest=[megabytes of morph targets]:megabytes:'
      '--turntable[pictures go once round the model]')
    ;;
  between)
    specs+=("*:shape:$cache" $output $digits $straight $rate "--rest=[the model at rest]:model:$mesh" '--frames=[how many]:frames:'
      '--at=[one moment: 1 is the second shape]:moment:(0.5 1 1.5)' '--loop[the last shape goes on to the first one]'
      '--linear[straight from shape to shape in log space]')
    ;;
  mix) specs+=("1:model at rest:$mesh" $output $digits $straight "*--shape=[a shape and how much of it, FILE=WEIGHT]:shape:$cache") ;;
  pose)
    specs+=("1:model at rest:$mesh" $output $digits "*--examples=[shapes of the model whose ways it has]:shape:$cache"
      '*--pin=[a vertex and where it is held, VERTEX=x,y,z]:pin: ' '*--pull=[a vertex and where it is pulled, VERTEX=x,y,z]:pin: '
      '--firmness=[how much vertices are pulled]:number: ' '--freedom=[how freely it turns off the blend of examples]:number:(0 0.3 1)'
      '--restraint=[how near to 0 weights of examples stay]:number: ') ;;
  cage) specs+=("1:mesh:$mesh" $output '--kind=[what cage]:kind:(automatic box hull)'
      '--triangles=[size of the cage]:triangles:(60 200 600)' '--margin=[distance to the mesh, percent]:percent:(0.15 0.5 2)'
      '--gap=[which gaps are closed, percent]:percent:(0.15 0.5 2)' '--symmetry=[about which plane]:symmetry:(auto none x y z)'
      '--quads[pair triangles to quads]' '--cells=[of boxes, along each axis]:cells:(1x1x1 2x2x2 3x3x3)'
      '--own-axes[of boxes, along the extents of the mesh]') ;;
  info) specs+=("--cage=[cage to check]:cage:$mesh" "*:mesh:$mesh") ;;
  manual) specs+=('1:chapter:(window cages blending time shapes files command_line python blender cpp figures)') ;;
  report) specs+=($meshes "*:pose:$mesh" $force '(-o --output)'{-o+,--output=}'[folder to write]:folder:_files -/' '--quick[fewer matrices, cages and rounds]') ;;
  'bench exp') specs+=($count $json $plot $float) ;;
  'bench eigen') specs+=($count $json $plot) ;;
  'bench accuracy') specs+=($count $json $float) ;;
  'bench sym3') specs+=($count $json) ;;
  'bench frame') specs+=($meshes $count $json $faces $rounds $tolerance) ;;
  'bench bind') specs+=($meshes $count $json $faces $rounds) ;;
  'bench modes') specs+=($meshes "*:pose:$mesh" $json $method $weighting $blend $limits $stitched $rounds) ;;
  'bench cage') specs+=("1:mesh:$mesh" $json) ;;
  'bench files') specs+=("1:mesh:$mesh" $json $rounds) ;;
  'bench stitched') specs+=($meshes "*:pose:$mesh" $json $rounds) ;;
  'bench time') specs+=("1:session:_files -g '*.(#i)viete(-.)'" $json $rounds) ;;
  'bench shapes') specs+=("*:mesh:$mesh" $json $rounds '--published=[folder with lion and horse, whose bars are checked]:folder:_files -/') ;;
  'bench '*) specs+=('1:benchmark:(exp eigen accuracy sym3 frame bind files cage modes stitched time shapes)') ;;
  *) # view, which may be left out
    specs+=($files $pose $method $weighting $blend $way $limits $amounts $stitched $scale '--frames=[close after so many frames]:frames:')
    [[ $command == view ]] || specs+=('--version[version, compiler and kernel]')
    ;;
esac

if ((CURRENT == 2)) && [[ $PREFIX != -* ]]; then
  local -a commands=('view:open the viewer' 'render:render a picture' 'deform:deform a mesh by a posed cage'
    'animate:write the frames of a timeline' 'between:what lies between shapes of a model' 'mix:mix shapes of a model' 'pose:pose a model by its vertices and by examples'
    'cage:make a cage around a mesh' 'info:what mesh files hold' 'manual:show the manual' 'bench:measure speed and accuracy'
    'report:write a page of figures, measured here'
    'help:what a command can do')
  _describe command commands
  eval "$any"
  return
fi

# The words of the command are no files.
local -i skip=0
[[ $command == (view|render|deform|animate|between|mix|pose|cage|info|manual|report|bench\ *) ]] && skip=1
[[ $command == bench\ (exp|eigen|accuracy|sym3|frame|bind|files|cage|modes|stitched|time|shapes) ]] && ((CURRENT > 3)) && skip=2
shift $skip words
((CURRENT -= skip))
_arguments -s $specs
