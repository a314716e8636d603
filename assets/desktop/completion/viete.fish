# viete(1) in fish. tests/consumer/completion.sh compares it with the program's own --help.

# The command is one of these; "view" may be left out.
function __viete_in
    set -l words (commandline -opc) view
    contains -- "$words[2]" view render deform animate between mix pose cage info manual bench report; or set words[2] view
    contains -- "$words[2]" $argv
end

# The benchmark is one of these.
function __viete_bench
    set -l words (commandline -opc)
    test "$words[2]" = bench; and contains -- "$words[3]" $argv
end

function __viete_first
    test (count (commandline -opc)) = $argv[1]
end

set -l c complete -c viete
$c -n '__viete_first 1' -a view -d 'Open the viewer'
$c -n '__viete_first 1' -a render -d 'Render a picture'
$c -n '__viete_first 1' -a deform -d 'Deform a mesh by a posed cage'
$c -n '__viete_first 1' -a animate -d 'Write the frames of a timeline'
$c -n '__viete_first 1' -a between -d 'What lies between shapes of a model'
$c -n '__viete_first 1' -a mix -d 'Mix shapes of a model'
$c -n '__viete_first 1' -a pose -d 'Pose a model by its vertices and by examples'
$c -n '__viete_first 1' -a cage -d 'Make a cage around a mesh'
$c -n '__viete_first 1' -a info -d 'What mesh files hold'
$c -n '__viete_first 1' -a manual -d 'Show the manual'
$c -n '__viete_first 1' -a bench -d 'Measure speed and accuracy'
$c -n '__viete_first 1' -a report -d 'Write a page of figures, measured here'
$c -n '__viete_first 1' -a help -d 'What a command can do'
$c -n '__viete_first 1' -l version -d 'Version, compiler and kernel'
$c -s h -l help -d 'What it can do'

$c -n '__viete_in manual' -x -a 'window cages blending time shapes files command_line python blender cpp figures'
$c -n '__viete_in report' -s o -l output -r -a '(__fish_complete_directories)' -d 'Folder to write'
$c -n '__viete_in report' -l quick -d 'Fewer matrices, cages and rounds'
$c -n '__viete_in render deform animate between mix pose cage' -s o -l output -r -d 'File to write'
$c -n '__viete_in render deform animate between mix pose cage report; or __viete_bench exp eigen accuracy sym3 frame bind files cage modes stitched time shapes' -l force -d 'Replace other files too'
$c -n '__viete_in deform animate between mix pose' -l digits -x -a 'all 4 6 9' -d 'Decimals of what moved in text files'
$c -n '__viete_in cage' -l kind -x -a 'automatic box hull' -d 'What cage'
$c -n '__viete_in cage' -l triangles -x -a '60 200 600' -d 'Size of the cage'
$c -n '__viete_in cage' -l margin -x -a '0.15 0.5 2' -d 'Distance to the mesh, percent'
$c -n '__viete_in cage' -l gap -x -a '0.15 0.5 2' -d 'Which gaps are closed, percent'
$c -n '__viete_in cage' -l symmetry -x -a 'auto none x y z' -d 'About which plane'
$c -n '__viete_in cage' -l quads -d 'Pair triangles to quads'
$c -n '__viete_in cage' -l cells -x -a '1x1x1 2x2x2 3x3x3' -d 'Of boxes, along each axis'
$c -n '__viete_in cage' -l own-axes -d 'Of boxes, along the extents of the mesh'
$c -n '__viete_in view render deform' -l pose -r -d 'Posed cage'
$c -n '__viete_in deform' -l mask -r -d 'How much of its motion each vertex makes'
$c -n '__viete_in deform' -l stream -d 'Poses from standard input, positions to standard output'
$c -n '__viete_in info view render deform animate' -l cage -r -d 'Cage to check, or in place of the session\'s'
$c -n '__viete_in view render deform animate' -l model -r -d 'Model in place of the session\'s'
$c -n '__viete_in view render deform animate; or __viete_bench modes' -l method -x -a 'fast diag sd improved_sd' -d 'How exp is computed'
$c -n '__viete_in view render deform animate; or __viete_bench modes' -l weights -x -a 'inverse cutoff harmonic biharmonic mean-value' -d 'How much of each map a vertex takes'
$c -n '__viete_in view render deform animate; or __viete_bench modes' -l blend -x -a 'srl mls-affine mls-similarity mls-rigid linear' -d 'What of the maps is summed'
$c -n '__viete_in view render deform animate' -l turn -x -a '0 50 100 200' -d 'How much of rotations acts, percent'
$c -n '__viete_in view render deform animate' -l stretch -x -a '0 50 100 200' -d 'How much of stretches acts, percent'
$c -n '__viete_in view render deform animate' -l way -x -a 'smooth paper mean-value rigid arap local' -d 'How the cage moves the mesh'
$c -n '__viete_in view render deform animate; or __viete_bench modes' -l radius -x -a '5 10 25 50' -d 'Where cut-off weights end, percent'
$c -n '__viete_in view render deform animate; or __viete_bench modes' -l stitched -d 'As rigid as possible'
$c -n '__viete_in view render deform animate; or __viete_bench modes' -l iterations -x -a '1 2 3 5' -d 'How often a stitched mesh is solved for'
$c -n '__viete_in view render deform animate; or __viete_bench modes' -l pins -x -a '0 5 10' -d 'How near to the cage a stitched mesh is pinned, percent'
$c -n '__viete_in view render deform animate; or __viete_bench modes' -l hold -x -a '0 5 20' -d 'How firmly a stitched mesh is held, percent'
$c -n '__viete_in animate; or __viete_bench frame' -l tolerance -x -d 'Of compressed weights, or of morph targets'
$c -n '__viete_in animate' -l no-normals -d 'Morph targets of positions alone'
$c -n '__viete_in animate' -l largest -x -d 'Megabytes of morph targets'
$c -n '__viete_in view render animate' -l scale -x -d 'Device pixels per logical pixel'
$c -n '__viete_in view animate between' -l frames -x -d 'First-last frame; of between how many; of view, close after so many'
$c -n '__viete_in between' -l at -x -a '0.5 1 1.5' -d 'One moment: 1 is the second shape'
$c -n '__viete_in between' -l rest -r -d 'The model at rest'
$c -n '__viete_in between' -l loop -d 'The last shape goes on to the first one'
$c -n '__viete_in between' -l linear -d 'Straight from shape to shape in log space'
$c -n '__viete_in mix' -l shape -r -d 'A shape, and how much of it: FILE=WEIGHT'
$c -n '__viete_in pose' -l examples -r -d 'Shapes of the model whose ways it has'
$c -n '__viete_in pose' -l pin -x -d 'A vertex and where it is held: VERTEX=x,y,z'
$c -n '__viete_in pose' -l pull -x -d 'A vertex and where it is pulled: VERTEX=x,y,z'
$c -n '__viete_in pose' -l firmness -x -d 'How much vertices are pulled'
$c -n '__viete_in pose' -l freedom -x -a '0 0.3 1' -d 'How freely it turns off the blend of examples'
$c -n '__viete_in pose' -l restraint -x -d 'How near to 0 weights of examples stay'
$c -n '__viete_in render animate' -l size -x -a '1280x800 1920x1080 3840x2160' -d 'Logical pixels'
$c -n '__viete_in render animate' -l look -x -a 'home front back left right top bottom' -d 'From where'
$c -n '__viete_in render animate' -l map -x -a 'none displacement area larger-stretch smaller-stretch shear turn energy volume gap exp-error frame-error influence opening difference signed-difference' -d 'What the mesh is coloured by, as in the Lab'
$c -n '__viete_in render animate' -l compare -x -a 'smooth paper mean-value rigid arap local diag sd improved_sd fast log straight' -d 'Ways or methods side by side'
$c -n '__viete_in render animate' -l camera -r -d 'Seen as that session is'
$c -n '__viete_in render animate' -l shading -x -a 'clay porcelain jade file checker normals zebra' -d 'What the mesh is coloured by'
$c -n '__viete_in render animate' -l panels -d 'With the panels'
$c -n '__viete_in render' -l pass -x -a 'none depth normals triangles occlusion' -d 'What is told of the model instead'
$c -n '__viete_in render animate' -l line-width -x -d 'Of the cage and of edges, in points'
$c -n '__viete_in render' -l transparent -d 'Without a background'
$c -n '__viete_in render animate' -l light -d 'Light theme'
$c -n '__viete_in render animate' -l wireframe -d 'With the edges of the mesh'
$c -n '__viete_in render animate' -l error-map -d 'With the error as colours'
$c -n '__viete_in render animate' -l show-cage -d 'With the cage'
$c -n '__viete_in render animate' -l no-grid -d 'Without the grid'
$c -n '__viete_in animate' -l keys -r -d 'Keys of other files'
$c -n '__viete_in animate' -l step -x -d 'Every so many frames'
$c -n '__viete_in animate between' -l rate -x -d 'Frames a second'
$c -n '__viete_in animate between mix' -l straight -d 'Straight lines from key to key, or shape to shape'
$c -n '__viete_in animate' -l turntable -d 'Pictures go once round the model'

$c -n '__viete_in bench; and __viete_first 2' -x -a 'exp eigen accuracy sym3 frame bind files cage modes stitched time shapes'
$c -n '__viete_bench exp eigen accuracy sym3 frame bind' -l count -x -d 'Matrices or vertices'
$c -n '__viete_bench exp eigen accuracy sym3 frame bind files cage modes stitched time shapes' -l json -r -d 'Also write the numbers'
$c -n '__viete_bench exp eigen' -l plot -r -d 'Also draw them'
$c -n '__viete_bench exp accuracy' -l float -d 'Single precision'
$c -n '__viete_bench frame bind' -l faces -x -d 'Triangles of the cage'
$c -n '__viete_bench frame bind files modes stitched time shapes' -l rounds -x -d 'Repetitions'
$c -n '__viete_bench shapes' -l published -r -a '(__fish_complete_directories)' -d 'Folder with lion and horse, whose bars are checked'
